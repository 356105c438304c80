// Residuals compared with what they consist of.
#pragma once

#include <string>
#include <vector>

#include "framework/assembly/assembly.hpp"
#include "framework/assembly/block_system.hpp"

namespace sprekk {

struct ResidualCheck {
  bool finite = true;
  bool converged = false;     ///< rows_hold and balances_hold
  bool rows_hold = false;     ///< every residual is small against its terms
  bool balances_hold = true;  ///< and those of conserved quantities against their turnover
  double imbalance = 0;       ///< the largest error of a quantity over its turnover, where that is above round-off
  std::vector<char> is_unbalanced;  ///< of each equation: it is one of a quantity whose balance does not hold
  double largest = 0;               ///< over the equations: largest residual over the magnitude of the equation's terms
  std::string equation;             ///< that has it
  std::vector<char> is_round_off;   ///< of each equation: its residual is round-off of its terms
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
/// each field's is such an equation, too.
///
/// What is exchanged may be any multiple of what is stored, and a residual that is small against it may be all of that.
/// So the balances of a conserved quantity also hold against their turnover (BalanceRows): neither the sum of
/// all absolute residuals nor their sum without what is exchanged, which has more digits, is above 100 × tolerance
/// times it, but for round-off. Not where values are fixed in place of balances, which lets an unknown amount in.
/// Collective.
ResidualCheck check_residual(const Assembly& assembly, const BlockSystem& system, double tolerance);

}  // namespace sprekk
