// Residuals compared with what they consist of.
#pragma once

#include <string>
#include <vector>

#include "framework/assembly/assembly.hpp"
#include "framework/assembly/block_system.hpp"

namespace sprekk {

struct ResidualCheck {
  bool finite = true;
  bool converged = false;
  double largest = 0;              ///< over the equations: largest residual over the magnitude of the equation's terms
  std::string equation;            ///< that has it
  std::vector<char> is_round_off;  ///< of each equation: its residual is round-off of its terms
  double merit = 0;                ///< sum of squares of the equations' relative residuals
};

/// An equation is fulfilled when its largest residual is at most `tolerance` times the largest of its terms, or is
/// round-off of those terms. Every equation is measured by its own terms, so the test needs no scales from the user and
/// does not depend on units. Collective.
ResidualCheck check_residual(const Assembly& assembly, const BlockSystem& system, double tolerance);

}  // namespace sprekk
