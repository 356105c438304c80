// Tests on residuals, errors of balances and changes whether further passes gain nothing.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace sprekk {

/// Whether the least value of the last `last_passes` passes is above 0.9 of the least value before. Residuals that fall
/// by a hundredth in a pass and scatter by as much again fall by a fifth in 25 passes.
bool hardly_fall(const std::vector<double>& values, std::size_t last_passes);
/// Whether errors of balances no longer fall, but scatter. Where passes converge slowly, errors fall in each pass.
bool are_round_off_of_balances(const std::vector<double>& imbalances);
/// Whether the error of the passes is below a bound, estimated from the changes by the last two.
bool is_error_below(double bound, double change, double change_before);
/// ", or ask for 1e-07 in 'until'": the tolerance to suggest where passes do not get below this residual; empty where
/// none is sensible.
std::string looser_tolerance(double residual);

}  // namespace sprekk
