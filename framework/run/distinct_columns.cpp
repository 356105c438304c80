#include "framework/run/distinct_columns.hpp"

#include <set>
#include <string>

#include "framework/config/input_error.hpp"

namespace sprekk {

void require_distinct_columns(const std::vector<Quantity>& quantities) {
  std::set<std::string> names;
  for (const Quantity& quantity : quantities)
    if (!names.insert(quantity.name).second)
      throw InputError("two columns of history.csv have the name '" + quantity.name +
                       "' (a probe, a place or a component gives it its name) rename one of them");
}

}  // namespace sprekk
