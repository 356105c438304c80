// The cheapest parameters for a wanted error.
#pragma once

#include <optional>
#include <vector>

#include "framework/converge/error_estimate.hpp"

namespace sprekk {

/// How the cost of a run grows as parameters get finer: by a power of each.
class CostModel {
 public:
  /// The ratio of the costs of the fine and of the middle level of the next parameter.
  void add(double ratio);
  double of(const std::vector<double>& factors) const;  ///< over that of the middle level

 private:
  std::vector<double> powers_;
};

/// The factors of the middle level that cost least, of all with a stated error of at most `wanted` for each value.
/// Nothing when none of those that are tried is good enough.
std::optional<std::vector<double>> cheapest_factors(const std::vector<ValueError>& errors,
                                                    const std::vector<double>& wanted, const CostModel& cost);

}  // namespace sprekk
