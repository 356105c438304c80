#include "framework/config/node.hpp"

#include <array>
#include <cctype>

namespace sprekk {
namespace {

std::string escaped(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (c == '\n') {
      result += "\\n";
    } else if (c == '\t') {
      result += "\\t";
    } else {
      result += c;
    }
  }
  return result + "\"";
}

}  // namespace

const Node* Node::find(const std::string& key) const {
  for (const Entry& entry : entries) {
    if (entry.key == key) return &entry.value;
  }
  return nullptr;
}

std::vector<std::string> Node::keys() const {
  std::vector<std::string> result;
  result.reserve(entries.size());
  for (const Entry& entry : entries) result.push_back(entry.key);
  return result;
}

std::string Node::text() const {
  if (is_null()) return "~";
  if (is_scalar()) return yaml_scalar(scalar);
  std::string result = is_list() ? "[" : "{";
  for (std::size_t i = 0; i < items.size(); ++i) result += (i == 0 ? "" : ", ") + items[i].text();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    result += (i == 0 ? "" : ", ") + yaml_scalar(entries[i].key) + ": " + entries[i].value.text();
  }
  return result + (is_list() ? "]" : "}");
}

std::string yaml_scalar(const std::string& text) {
  static const std::string special_first = "-?:,[]{}#&*!|>'\"%@` ";
  static const std::array<std::string, 5> nulls = {"", "~", "null", "Null", "NULL"};
  for (const std::string& null : nulls) {
    if (text == null) return escaped(text);
  }
  const bool is_negative_number =
      text.size() > 1 && text[0] == '-' && (std::isdigit(static_cast<unsigned char>(text[1])) != 0 || text[1] == '.');
  const bool ends_document = text.rfind("...", 0) == 0;
  const bool needs_quotes =
      ends_document || (special_first.find(text[0]) != std::string::npos && !is_negative_number) ||
      text.find_first_of("\n\r\t,[]{}\"\\?") != std::string::npos || text.find(": ") != std::string::npos ||
      text.find(" #") != std::string::npos || text.back() == ' ' || text.back() == ':';
  return needs_quotes ? escaped(text) : text;
}

}  // namespace sprekk
