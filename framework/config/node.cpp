#include "framework/config/node.hpp"

#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <array>
#include <cctype>
#include <optional>
#include <sstream>

#include "framework/config/node_paths.hpp"
#include "framework/config/text_file.hpp"
#include "framework/config/yaml_builder.hpp"

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

/// Finds the commonest mistake, which the parser does not name: a tab in the indentation of a line, or of the line
/// above.
std::optional<Origin> tab_in_indentation(const std::string& text, const std::string& source, int line_of_error) {
  std::istringstream lines(text);
  int line = 0;
  for (std::string content; std::getline(lines, content) && line <= line_of_error;) {
    ++line;
    const std::size_t first = content.find_first_not_of(' ');
    const bool is_near = line + 1 >= line_of_error;
    if (is_near && first != std::string::npos && content[first] == '\t') {
      return Origin{source, line, static_cast<int>(first) + 1};
    }
  }
  return std::nullopt;
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

void set_paths(Node& node, const std::string& path) {
  node.path = path;
  for (std::size_t i = 0; i < node.items.size(); ++i) set_paths(node.items[i], joined_path(path, std::to_string(i)));
  for (Node::Entry& entry : node.entries) set_paths(entry.value, joined_path(path, entry.key));
}

Node parse_yaml(const std::string& text, const std::string& source_name) {
  require_text(text, source_name);
  std::istringstream stream(text);
  YamlBuilder builder(source_name);
  try {
    YAML::Parser parser(stream);
    parser.HandleNextDocument(builder);
    YamlBuilder second(source_name);
    if (parser.HandleNextDocument(second)) {
      throw InputError(second.take_root().origin, "a second YAML document begins here", "a scene is one document",
                       "remove the line '---' or use two files");
    }
  } catch (const YAML::Exception& error) {
    if (const auto tab = tab_in_indentation(text, source_name, error.mark.line + 1)) {
      throw InputError(*tab, "malformed YAML", "a tab stands in the indentation", "use spaces");
    }
    throw InputError({source_name, error.mark.line + 1, error.mark.column + 1}, "malformed YAML", error.msg,
                     "check indentation, colons, quotes and brackets here and just above");
  }
  Node root = builder.take_root();
  set_paths(root, "");
  return root;
}

}  // namespace sprekk
