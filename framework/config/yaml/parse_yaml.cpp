#include "framework/config/yaml/parse_yaml.hpp"

#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <optional>
#include <sstream>

#include "framework/config/node_paths.hpp"
#include "framework/config/text_file.hpp"
#include "framework/config/yaml/likely_mistake.hpp"
#include "framework/config/yaml/yaml_builder.hpp"

namespace sprekk {
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
    if (const std::optional<InputError> mistake = likely_mistake(text, source_name)) throw *mistake;
    if (const std::optional<InputError> mistake = mistake_above(text, error.mark.line + 1, source_name)) throw *mistake;
    throw InputError({source_name, error.mark.line + 1, error.mark.column + 1}, "malformed YAML", error.msg,
                     "check indentation, colons, quotes and brackets here and just above");
  }
  Node root = builder.take_root();
  if (const std::optional<InputError> mistake = unclosed_quote(text, source_name)) throw *mistake;
  set_paths(root, "");
  return root;
}

}  // namespace sprekk
