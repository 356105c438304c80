#include "framework/schedule/passes/ends_of_passes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>

namespace sprekk {

bool hardly_fall(const std::vector<double>& values, std::size_t last_passes) {
  constexpr double hardly_less = 0.9;  // of the least value before
  if (values.size() <= last_passes) return false;
  const auto last = values.end() - static_cast<std::ptrdiff_t>(last_passes);
  return *std::min_element(last, values.end()) > hardly_less * *std::min_element(values.begin(), last);
}

bool are_round_off_of_balances(const std::vector<double>& imbalances) {
  constexpr std::size_t without_better_balance = 10;  // passes, of which not all bring it lower
  return hardly_fall(imbalances, without_better_balance) &&
         !std::is_sorted(imbalances.end() - without_better_balance, imbalances.end(), std::greater<>());
}

bool is_error_below(double bound, double change, double change_before) {
  constexpr double far_below = 1e-2;  // of the bound: changes so small may be round-off, and fall no more
  if (change <= far_below * bound) return true;
  return change <= bound && change < change_before && change * change / (change_before - change) <= bound;
}

std::string looser_tolerance(double residual) {
  constexpr double sensible = 1e-5;  // fields with fewer digits are no answer
  if (residual > sensible) return "";
  return fmt::format(", or ask for {:.0e} in 'until'", std::pow(10, std::floor(std::log10(residual)) + 1));
}

}  // namespace sprekk
