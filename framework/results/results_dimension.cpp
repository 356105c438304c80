#include "framework/results/results_dimension.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

namespace sprekk {

int dimension_of_results(const std::filesystem::path& folder) {
  std::ifstream file(folder / "run.json");
  const auto record = nlohmann::json::parse(file, nullptr, false);
  return record.is_object() ? record.value("dimension", 2) : 2;
}

}  // namespace sprekk
