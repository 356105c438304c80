#include "framework/report/fracture_names.hpp"

#include <nlohmann/json.hpp>

namespace sprekk {

std::vector<std::string> fracture_names(const std::string& record, std::size_t count) {
  const auto read = nlohmann::ordered_json::parse(record);
  std::vector<std::string> names = read.value("/scene/fractures"_json_pointer, std::vector<std::string>());
  if (names.size() == count) return names;
  names.clear();
  for (std::size_t i = 0; i < count; ++i) names.push_back("fracture " + std::to_string(i + 1));
  return names;
}

}  // namespace sprekk
