#include "framework/meshing/msh_cursor.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "framework/config/input_error.hpp"

namespace sprekk {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

/// std::from_chars does not accept a plus sign.
std::string_view without_plus(std::string_view word) {
  return word.size() > 1 && word[0] == '+' && word[1] != '-' ? word.substr(1) : word;
}

template <class Value>
std::errc parse(std::string_view word, Value& value) {
  const std::string_view digits = without_plus(word);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc()) return error;
  return end == digits.data() + digits.size() ? std::errc() : std::errc::invalid_argument;
}

}  // namespace

void MshCursor::fail_at(std::size_t position, const std::string& problem) const {
  position = std::min(position, bytes_.size());
  if (is_binary_) throw InputError("byte " + std::to_string(position) + ": " + problem);
  const auto lines = std::count(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(position), '\n');
  throw InputError("line " + std::to_string(lines + 1) + ": " + problem);
}

void MshCursor::skip_blanks() {
  while (at_ < bytes_.size() && is_blank(bytes_[at_])) ++at_;
}

std::string_view MshCursor::word(const char* what) {
  skip_blanks();
  const std::size_t begin = at_;
  while (at_ < bytes_.size() && !is_blank(bytes_[at_])) ++at_;
  if (at_ == begin) fail(std::string("the file ends where ") + what + " is expected");
  return bytes_.substr(begin, at_ - begin);
}

std::string_view MshCursor::rest_of_line() {
  const std::size_t begin = at_, end = std::min(bytes_.find('\n', at_), bytes_.size());
  at_ = std::min(end + 1, bytes_.size());
  std::string_view line = bytes_.substr(begin, end - begin);
  while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
  while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
  return line;
}

bool MshCursor::skip_past(std::string_view text) {
  const std::size_t found = bytes_.find(text, at_);
  if (found == std::string_view::npos) return false;
  at_ = found + text.size();
  return true;
}

template <class Value>
Value MshCursor::raw(const char* what) {
  Value value;
  if (remaining() < sizeof value) fail(std::string("the file ends where ") + what + " is expected");
  std::memcpy(&value, bytes_.data() + at_, sizeof value);
  at_ += sizeof value;
  return value;
}

template <class Value>
Value MshCursor::whole(const char* what) {
  const std::string_view text = word(what);
  Value value{};
  if (parse(text, value) == std::errc()) return value;
  fail_at(at_ - text.size(), quoted(std::string(text)) + " stands where " + what + " is expected");
}

int MshCursor::text_integer(const char* what) { return whole<int>(what); }

int MshCursor::integer(const char* what) { return is_binary_ ? raw<std::int32_t>(what) : whole<int>(what); }

std::uint64_t MshCursor::number(const char* what) {
  return is_binary_ ? raw<std::uint64_t>(what) : whole<std::uint64_t>(what);
}

double MshCursor::real(const char* what) {
  std::size_t begin = at_;
  double value = 0;
  std::string text;
  if (is_binary_) {
    value = raw<double>(what);
    text = std::to_string(value);
  } else {
    text = word(what);
    begin = at_ - text.size();
    const std::errc error = parse(text, value);
    // A number below the range of double is treated as zero.
    if (error == std::errc::result_out_of_range) value = std::strtod(text.c_str(), nullptr);
    if (error == std::errc::invalid_argument) {
      fail_at(begin, sprekk::quoted(text) + " stands where " + what + " is expected");
    }
  }
  if (!std::isfinite(value)) fail_at(begin, sprekk::quoted(text) + " is no finite number");
  return value;
}

std::size_t MshCursor::count(const char* what, std::size_t least_bytes, bool is_wide) {
  const std::size_t begin = at_;
  std::uint64_t value = 0;
  if (is_wide) {
    value = number(what);
  } else {
    const int narrow = integer(what);
    if (narrow < 0) fail_at(begin, std::to_string(narrow) + " stands where " + what + " is expected");
    value = static_cast<std::uint64_t>(narrow);
  }
  if (value > remaining() / least_bytes) {
    fail_at(begin, std::string(what) + " is " + std::to_string(value) + ", more than the rest of the file can hold");
  }
  return value;
}

std::size_t MshCursor::wide_count(const char* what, std::size_t binary, std::size_t values) {
  return count(what, std::max<std::size_t>(1, least_bytes(binary, values)), true);
}

}  // namespace sprekk
