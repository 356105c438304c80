#include "framework/output/parameter_difference.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

namespace sprekk {
namespace {

bool may_change(const std::string& path) {
  return path == "name" || path == "time.end" || path == "output" || path.rfind("output.", 0) == 0;
}

}  // namespace

std::string parameter_difference(const std::filesystem::path& run_json, const std::vector<RunRecord::Parameter>& now) {
  std::ifstream file(run_json);
  const auto record = nlohmann::ordered_json::parse(file, nullptr, false);
  const nlohmann::ordered_json::json_pointer place("/scene/parameters");
  if (record.is_discarded() || !record.contains(place)) return "";
  const auto& before = record.at(place);
  std::set<std::string> known;
  for (const RunRecord::Parameter& parameter : now) {
    known.insert(parameter.path);
    if (may_change(parameter.path)) continue;
    const auto found = before.find(parameter.path);
    if (found == before.end()) return parameter.path + " is new";
    const std::string value = found->value("value", "");
    if (value != parameter.value) return parameter.path + " was " + value + " and is " + parameter.value;
  }
  for (const auto& [path, value] : before.items())
    if (!may_change(path) && known.count(path) == 0) return path + " is gone";
  return "";
}

}  // namespace sprekk
