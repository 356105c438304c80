// The parameters of tips whose factors follow from jumps.
#pragma once

#include <string>

#include "framework/assembly/notes.hpp"
#include "framework/config/spec.hpp"
#include "framework/types.hpp"

namespace sprekk::fine_fracture {

/// Parameters of such tips, and of such fronts in space.
struct JumpFitOptions {
  // In space mean errors of K_I, K_II and K_III of circles with eight cells on the radius are 0.5 % with these and 0.5,
  // 1.5 and 1.1 % with those of the plane, whose elements are better at tips.
  int cells = dimension == 2 ? 3 : 4;      ///< of the fracture, whose jumps the line goes through
  int leave_out = dimension == 2 ? 1 : 2;  ///< cells at the tip that it does not go through
  Spec spec();
};

/// Of the factors: a change by one cell less in their fit, from which on a note tells of it.
inline constexpr double uncertain = 0.1;

void note_without_jumps(const std::string& name, Notes& notes);

}  // namespace sprekk::fine_fracture
