#include "framework/schedule/relative_change.hpp"

#include <algorithm>
#include <map>
#include <string>

#include "framework/invariants.hpp"

namespace sprekk {

double relative_change(const std::vector<const Field*>& fields) {
  std::map<std::string, double> scale, change;
  for (const Field* field : fields) {
    if (field->size() == 0) continue;
    SPREKK_EXPECT(is_finite(field->now()), field->name());
    const std::string& unit = field->spec().unit;
    scale[unit] =
        std::max({scale[unit], field->now().lpNorm<Eigen::Infinity>(), field->accepted().lpNorm<Eigen::Infinity>()});
    change[unit] = std::max(change[unit], (field->now() - field->accepted()).lpNorm<Eigen::Infinity>());
  }
  double largest = 0;
  for (const auto& [unit, size] : change)
    if (scale[unit] > 0) largest = std::max(largest, size / scale[unit]);
  return largest;
}

}  // namespace sprekk
