// Residuals compared with the terms that they are sums of.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "framework/assembly/assembly.hpp"
#include "framework/assembly/block_system.hpp"

namespace sprekk {

/// The residuals of an assembly, compared with their terms; all figures are relative unless said otherwise.
struct ResidualCheck {
  bool finite = true;
  std::string without_value;   ///< if a formula has no value: its message; the residual is not finite
  bool converged = false;      ///< rows_hold, balances_hold and each_row_holds
  bool rows_hold = false;      ///< every residual is small against its terms
  bool balances_hold = true;   ///< the residuals of each conserved quantity are small against its throughput
  bool each_row_holds = true;  ///< each residual of a balance on an interface is small against the terms of its own row
  double row_error = 0;        ///< the largest of these residuals over its terms, where one is not
  double imbalance = 0;  ///< the largest error of a quantity over its throughput, where the error exceeds round-off
  std::vector<char> is_unbalanced;  ///< for each equation: it belongs to a quantity whose balance does not hold
  double largest = 0;               ///< over the equations: largest residual over the magnitude of the equation's terms
  std::string equation;             ///< the equation that has the largest
  std::vector<std::pair<std::string, double>> of_equations;  ///< each: its name, and what `largest` is for it alone
  std::vector<char> is_round_off;         ///< for each equation: its residual is round-off of its terms
  std::vector<char> is_round_off_in_sum;  ///< for each equation: the same for the sum of its rows, where that counts
  /// For each equation, and then for the sum of the rows of each: mean square of the residuals, magnitude of the terms,
  /// and largest error of fixed rows.
  std::vector<double> mean_squares, magnitudes, fixed_errors;

  /// The sum over the equations of mean squared residuals, each relative to the magnitude of its terms in `scales`.
  /// The scales of one state make two other states comparable: terms that grow with the unknowns would hide progress.
  double merit(const ResidualCheck& scales) const;
  std::string why_not_finite() const {
    return without_value.empty() ? "the residual of " + equation + " is not finite" : without_value;
  }
};

/// The tolerance of balances, of one row or of all, over that of residuals.
constexpr double looser_for_balances = 100;

/// An equation is fulfilled when its largest residual is at most `tolerance` times the largest of its terms, or is
/// round-off of those terms. Every equation is measured by its own terms, so the test needs no scales from the user and
/// does not depend on units. If the sum of balances replaces one of them (BlockSystem::use_sums), the sum of the
/// balances of each field is checked like an equation, too. If one row has the sum of several fields, the sums of
/// single fields may be off by the round-off of exchanges in other rows; then only the total of all fields is checked.
///
/// Rows may exchange any multiple of what they store, so a residual that is small against the exchange may be as large
/// as all of the storage. So the balances of a conserved quantity are also compared with their throughput
/// (BalanceRows): neither the sum of all absolute residuals, nor their sum without exchanges, which has more digits,
/// may exceed 100 × tolerance times the throughput, apart from round-off. Balances that are replaced by fixed values
/// are left out, since an unknown amount enters there.
///
/// One fracture may conduct any multiple of what another one stores. So each balance of an interface, where fluxes are
/// unknowns, is compared with its own row as well, by the componentwise backward error (Oettli and Prager 1964; Arioli,
/// Demmel and Duff 1989): |r_i| is at most 100 × tolerance times (|A| |x|)_i plus the throughput of the row, or the
/// round-off of these terms. For values of the cell itself x is the change in the step, from which its storage follows.
/// Collective.
ResidualCheck check_residual(const Assembly& assembly, const BlockSystem& system, double tolerance);

}  // namespace sprekk
