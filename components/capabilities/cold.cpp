#include "components/capabilities/cold.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sprekk {
namespace {

constexpr double coldest = 184;  // K, of the air in Vostok in 1983, the coldest place on earth (WMO archive)

}  // namespace

void note_cold(Notes& notes, const std::string& name, const Vector& at_start, const std::vector<const Data*>& given) {
  if (at_start.size() == 0) return;
  double lowest = at_start.minCoeff(), highest_given = 0;
  const bool starts_cold = lowest < coldest;
  for (const Data* data : given) {
    if (!data->is_constant()) continue;
    const double value = data->at({});
    lowest = std::min(lowest, value);
    highest_given = std::max(highest_given, value);
  }
  const bool are_differences = at_start.isZero(0) && highest_given < coldest;
  if (lowest >= coldest || are_differences) return;
  notes.add("temperatures near 0 K",
            fmt::format("'{}' has temperatures down to {:.4g} K{} (colder than any place on earth: temperatures count "
                        "from absolute zero, -273.15 degrees Celsius) add 273.15 to degrees Celsius, and give "
                        "'initial_temperature'",
                        name, lowest, starts_cold ? " at the start" : ""),
            coldest - lowest);
}

}  // namespace sprekk
