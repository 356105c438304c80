// How near the walls of a fracture are to sliding.
#pragma once

#include "components/contact/laws/strength.hpp"
#include "framework/types.hpp"

namespace sprekk::contact {

/// Figures of the contact traction of a cell.
struct ShearLoad {
  double slip_tendency;  ///< |tau| / sigma_n', shear over normal contact traction (Morris, Ferrill, Henderson 1996)
  double friction_used;  ///< |tau| over what the walls hold, C + mu sigma_n': 1 where they slide
};

/// `traction`: (normal, tangential), Pa, the normal one negative in contact, beside the pressure of the fluid. Walls
/// that have parted hold nothing: friction is used up, and the slip tendency is mu, as of walls that slide until they
/// part. Walls that touch without a load have 0 for both.
ShearLoad shear_load(const Point& traction, const Strength& strength, bool has_parted);

}  // namespace sprekk::contact
