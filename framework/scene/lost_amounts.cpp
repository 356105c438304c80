#include "framework/scene/lost_amounts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprekk {

std::string find_lost_amounts(const std::map<std::string, Balance>& before, const std::map<std::string, Balance>& after,
                              double tolerance, const std::function<StepAmounts(const std::string&)>& amounts_of) {
  constexpr double round_off = 64 * std::numeric_limits<double>::epsilon();  // of totals since the start
  for (const auto& [name, total] : after) {
    if (!total.is_closed) continue;
    const auto found = before.find(name);
    const Balance start = found == before.end() ? Balance() : found->second;
    const double stored = total.stored - start.stored, injected = total.injected - start.injected,
                 outflow = total.outflow - start.outflow;
    const double error = std::abs(stored + outflow - injected);
    double moved = std::max({std::abs(stored), std::abs(injected), std::abs(outflow)});
    if (error <= tolerance * moved) continue;
    const StepAmounts amounts = amounts_of(name);
    moved = std::max(moved, amounts.moved);
    const double totals = std::max(total.throughput, start.throughput);
    if (error <= tolerance * moved + amounts.round_off + round_off * totals) continue;
    return fmt::format(
        "the balance of {} is off by {:.2g} {}, {:.2g} of what was moved in the step (what is stored, has entered and "
        "has left does not add up)",
        name, error, total.unit, error / moved);
  }
  return "";
}

}  // namespace sprekk
