#include "framework/outside/message.hpp"

#include <algorithm>
#include <cstring>
#include <sstream>

#include "framework/outside/outside_error.hpp"

namespace sprekk {

namespace {

constexpr std::size_t longest_line = 1000;  // of names and numbers: what is longer is something else
constexpr long most_values = 1L << 31;      // in one item: more than any mesh has

template <class Items>
auto find_item(const Items& items, const std::string& name) -> decltype(&items.front().second) {
  const auto found = std::ranges::find_if(items, [&](const auto& item) { return item.first == name; });
  return found == items.end() ? nullptr : &found->second;
}

void add_item(std::string& bytes, const std::string& name, const char* type, const void* values, std::size_t count,
              std::size_t size) {
  bytes += name + " " + type + " " + std::to_string(count) + "\n";
  bytes.append(static_cast<const char*>(values), count * size);
}

OutsideError no_message(const std::string& line) {
  constexpr std::size_t shown = 60;  // bytes, enough to recognize it by
  std::string text = line.substr(0, shown);
  std::ranges::replace_if(
      text, [](char c) { return c < ' ' || c > '~'; }, '?');
  return OutsideError("answers '" + text +
                      "', which is no message (print nothing to its standard output: it is for messages alone)");
}

}  // namespace

const Vector* OutsideMessage::real(const std::string& name) const { return find_item(reals, name); }
const std::vector<int>* OutsideMessage::integers(const std::string& name) const { return find_item(ints, name); }
const std::string* OutsideMessage::text(const std::string& name) const { return find_item(texts, name); }

std::string OutsideMessage::bytes() const {
  std::string all = word + " " + std::to_string(reals.size() + ints.size() + texts.size()) + "\n";
  for (const auto& [name, values] : texts) add_item(all, name, "text", values.data(), values.size(), 1);
  for (const auto& [name, values] : ints) add_item(all, name, "int", values.data(), values.size(), sizeof(int));
  for (const auto& [name, values] : reals)
    add_item(all, name, "real", values.data(), static_cast<std::size_t>(values.size()), sizeof(double));
  return all;
}

void ArrivingMessage::take(const char* bytes, std::size_t count) { bytes_.append(bytes, count); }

bool ArrivingMessage::take_line(std::string& line) {
  const std::size_t end = bytes_.find('\n', at_);
  if (end == std::string::npos) {
    if (bytes_.size() - at_ > longest_line) throw no_message(bytes_.substr(at_));
    return false;
  }
  line = bytes_.substr(at_, end - at_);
  return true;
}

bool ArrivingMessage::is_complete() {
  if (!has_word_) {
    std::string line;
    if (!take_line(line)) return false;
    std::istringstream words(line);
    std::string more;
    if (!(words >> message_.word >> left_) || left_ < 0 || words >> more) throw no_message(line);
    at_ += line.size() + 1;
    has_word_ = true;
  }
  while (left_ > 0 && take_item()) --left_;
  if (left_ == 0 && at_ < bytes_.size()) throw no_message(bytes_.substr(at_));
  return left_ == 0;
}

bool ArrivingMessage::take_item() {
  std::string line, name, type, more;
  if (!take_line(line)) return false;
  std::istringstream words(line);
  long count = 0;
  if (!(words >> name >> type >> count) || count < 0 || count > most_values || words >> more) throw no_message(line);
  const std::size_t size = type == "real" ? sizeof(double) : type == "int" ? sizeof(int) : type == "text" ? 1 : 0;
  if (size == 0) throw no_message(line);
  const std::size_t begin = at_ + line.size() + 1, length = static_cast<std::size_t>(count) * size;
  if (bytes_.size() < begin + length) return false;
  const char* values = bytes_.data() + begin;
  if (type == "text") message_.texts.emplace_back(name, std::string(values, length));
  if (type == "int") {
    std::memcpy(message_.ints.emplace_back(name, std::vector<int>(count)).second.data(), values, length);
  }
  if (type == "real") std::memcpy(message_.reals.emplace_back(name, Vector(count)).second.data(), values, length);
  at_ = begin + length;
  return true;
}

}  // namespace sprekk
