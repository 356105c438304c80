#include "framework/study/quantiles.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "framework/no_value.hpp"

namespace sprekk {

Distribution distribution_of(const std::vector<double>& numbers) {
  std::vector<double> sorted;
  std::copy_if(numbers.begin(), numbers.end(), std::back_inserter(sorted), [](double x) { return std::isfinite(x); });
  std::sort(sorted.begin(), sorted.end());
  Distribution result{static_cast<int>(sorted.size()), no_value, no_value, {}};
  result.quantiles.fill(no_value);
  if (sorted.empty()) return result;
  result.mean = std::accumulate(sorted.begin(), sorted.end(), 0.0) / result.count;
  double squares = 0;
  for (const double x : sorted) squares += (x - result.mean) * (x - result.mean);
  if (result.count > 1) result.deviation = std::sqrt(squares / (result.count - 1));
  for (std::size_t k = 0; k < quantile_shares.size(); ++k) {
    const double place = quantile_shares[k] * (result.count - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    result.quantiles[k] = sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
  }
  return result;
}

}  // namespace sprekk
