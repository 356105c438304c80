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
  std::vector<char> is_round_off_in_sum;  ///< of each equation, the same of the sum of its rows where that counts
  /// Of each equation, and then of the sum of each: of its residuals, its terms.
  std::vector<double> mean_squares, magnitudes, fixed_errors;

  /// The sum over the equations of mean squared residuals, each relative to the magnitude of its terms in `scales`.
  /// With the scales of one state two others can be compared: terms that grow with the unknowns would hide progress.
  double merit(const ResidualCheck& scales) const;
};

/// An equation is fulfilled when its largest residual is at most `tolerance` times the largest of its terms, or is
/// round-off of those terms. Every equation is measured by its own terms, so the test needs no scales from the user and
/// does not depend on units. Where the system puts a sum of balances in their place (BlockSystem::use_sums), the sum of
/// each field's is such an equation, too. Collective.
ResidualCheck check_residual(const Assembly& assembly, const BlockSystem& system, double tolerance);

}  // namespace sprekk
