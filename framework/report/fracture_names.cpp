#include "framework/report/fracture_names.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace sprekk {

std::vector<std::string> fracture_names(const std::string& record, std::size_t count) {
  const std::string head = "geometry.fractures.";
  std::vector<std::string> names;
  const auto read = nlohmann::ordered_json::parse(record);
  const auto parameters = read.value("/scene/parameters"_json_pointer, nlohmann::ordered_json::object());
  for (const auto& [path, parameter] : parameters.items()) {
    if (path.rfind(head, 0) != 0) continue;
    const std::string name = path.substr(head.size(), path.find('.', head.size()) - head.size());
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  if (names.size() == count) return names;
  names.clear();
  for (std::size_t i = 0; i < count; ++i) names.push_back("fracture " + std::to_string(i + 1));
  return names;
}

}  // namespace sprekk
