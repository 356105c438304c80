#include "framework/run/cumulative_balance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sprekk {

namespace {

constexpr double most = 1e-6;  ///< of the throughput: a hundred times what steps are accepted with
const std::string key = "cumulative_balance.throughput.";

}  // namespace

void CumulativeBalance::note_step(const std::map<std::string, Balance>& balances, double tolerance, Notes& notes) {
  for (const auto& [name, balance] : balances) {
    double& throughput = throughput_[name];
    // At least the amounts themselves: a part may give no throughput, or sums in which terms of different places
    // cancel.
    throughput = std::max({throughput, balance.throughput, std::abs(balance.stored), std::abs(balance.injected),
                           std::abs(balance.outflow)});
    const double error = std::abs(balance.stored + balance.outflow - balance.injected);
    if (tolerance <= most || !balance.is_closed || !(error > most * throughput)) continue;
    notes.add(name + "_balance_error",
              fmt::format("the balance of {} is off by {:.2g} {}, {:.2g} of all that was moved (what is stored, has "
                          "entered and has left does not add up) lower newton.residual, or take smaller steps",
                          name, error, balance.unit, error / throughput),
              error / throughput);
  }
}

void CumulativeBalance::save(std::map<std::string, Vector>& state) const {
  for (const auto& [name, value] : throughput_) state[key + name] = Vector::Constant(1, value);
}

void CumulativeBalance::restore(const std::map<std::string, Vector>& state) {
  for (const auto& [name, value] : state)
    if (name.starts_with(key) && value.size() == 1) throughput_[name.substr(key.size())] = value[0];
}

}  // namespace sprekk
