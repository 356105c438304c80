#include "couplers/well_exchange/rock_openings.hpp"

#include <fmt/format.h>

#include "framework/config/input_error.hpp"

namespace sprekk::couplers {

void require_positive_index(const WellPlace& place, double log_of_radii, double around, double bore) {
  if (log_of_radii > 0) return;
  throw InputError(place.origin, "the index of well '" + place.name + "' is not positive",
                   fmt::format("ln(r_e/r_w) + skin is {:.3g}: the cells have the pressure of the well at r_e = {:.3g} "
                               "m, and its radius is {:.3g} m",
                               log_of_radii, around, bore),
                   "use larger cells, a smaller radius, or a larger skin");
}

}  // namespace sprekk::couplers
