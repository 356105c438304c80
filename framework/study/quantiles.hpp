// How the figures of samples are distributed.
#pragma once

#include <array>
#include <vector>

namespace sprekk {

/// The shares of the samples that lie below the quantiles.
constexpr std::array<double, 5> quantile_shares = {0.05, 0.25, 0.5, 0.75, 0.95};

/// Mean, standard deviation (with count − 1) and quantiles of numbers; NaN where there are too few.
struct Distribution {
  int count = 0;
  double mean, deviation;
  std::array<double, quantile_shares.size()> quantiles;
};

/// Of all finite numbers. A quantile is linear between the sorted numbers, which stand at the shares 0, 1/(n − 1), …, 1
/// (type 7 of Hyndman and Fan 1996, The American Statistician 50, 361).
Distribution distribution_of(const std::vector<double>& numbers);

}  // namespace sprekk
