#include "framework/config/yaml/parse_yaml.hpp"

#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <optional>
#include <sstream>

#include "framework/config/node_paths.hpp"
#include "framework/config/text_file.hpp"
#include "framework/config/yaml/yaml_builder.hpp"

namespace sprekk {
namespace {

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
