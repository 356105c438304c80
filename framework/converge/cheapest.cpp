#include "framework/converge/cheapest.hpp"

#include <algorithm>
#include <cmath>

namespace sprekk {
namespace {

// Factors that are tried: 2^(k/2) of the middle level. Beyond the coarsest level nothing is known.
constexpr int coarsest_step = 2, finest_step = -12;
constexpr double least_power = 0.25, most_power = 3;  // of the cost: measured seconds of short runs are noise

}  // namespace

void CostModel::add(double ratio) { powers_.push_back(std::clamp(std::log2(ratio), least_power, most_power)); }

double CostModel::of(const std::vector<double>& factors) const {
  double cost = 1;
  for (std::size_t i = 0; i < factors.size(); ++i) cost *= std::pow(factors[i], -powers_[i]);
  return cost;
}

std::optional<std::vector<double>> cheapest_factors(const std::vector<ValueError>& errors,
                                                    const std::vector<double>& wanted, const CostModel& cost) {
  const std::size_t count = errors.front().parameters.size();
  std::vector<int> steps(count, coarsest_step);
  std::optional<std::vector<double>> best;
  for (;;) {
    std::vector<double> factors;
    for (const int step : steps) factors.push_back(std::pow(2, step / 2.0));
    bool is_good = true;
    for (std::size_t i = 0; i < errors.size() && is_good; ++i) is_good = errors[i].stated(factors) <= wanted[i];
    if (is_good && (!best || cost.of(factors) < cost.of(*best))) best = factors;
    std::size_t next = 0;
    while (next < count && steps[next] == finest_step) steps[next++] = coarsest_step;
    if (next == count) return best;
    --steps[next];
  }
}

}  // namespace sprekk
