// How near the walls of a fracture are to sliding.
#pragma once

#include "components/contact/laws/strength.hpp"
#include "framework/types.hpp"

namespace sprekk::contact {

/// Figures of the contact traction of a cell.
struct ShearLoad {
  double slip_tendency;  ///< |tau| / sigma_n', shear over normal contact traction (Morris, Ferrill, Henderson 1996)
  double friction_used;  ///< |tau| over the shear strength C + mu sigma_n': 1 where the walls slide
};

/// `traction`: (normal, tangential), Pa, the normal one negative in contact, without the fluid pressure. Walls that
/// have parted carry no traction: by convention friction_used is then 1 and slip_tendency mu, the values of walls that
/// slide just before they part. Walls that touch without a load have 0 for both.
ShearLoad shear_load(const Point& traction, const Strength& strength, bool has_parted);

}  // namespace sprekk::contact
