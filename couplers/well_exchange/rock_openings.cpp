#include "couplers/well_exchange/rock_openings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/config/input_error.hpp"

namespace sprekk::couplers {

double widened_radius(const WellPlace& place) { return place.radius * std::exp(-std::min(place.skin, 0.0)); }

double skin_beside_radius(const WellPlace& place) { return std::max(place.skin, 0.0); }

void refuse_flow(const WellPlace& place, const std::string& why) {
  throw InputError(place.origin, "the index of well '" + place.name + "' is not known for this flow", why,
                   "use matrix_flow/mpfa or matrix_flow/tpfa, or give its 'index'");
}

void require_positive_index(const WellPlace& place, double log_of_radii, double around) {
  if (log_of_radii > 0) return;
  throw InputError(place.origin, "the index of well '" + place.name + "' is not positive",
                   fmt::format("ln(r_e/r_w) + skin is {:.3g}: the cells have the pressure of the well at r_e = {:.3g} "
                               "m, and its radius is {:.3g} m",
                               log_of_radii, around, place.radius),
                   "use larger cells, a smaller radius, or a larger skin");
}

}  // namespace sprekk::couplers
