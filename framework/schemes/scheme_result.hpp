// What runs of schemes have given.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/schemes/scheme.hpp"

namespace sprekk {

/// What a scheme has done.
struct SchemeResult {
  Scheme scheme;
  std::string run;  ///< its folder below that of the atlas
  bool is_done = false;
  std::string reason;               ///< why not
  std::vector<int> passes;          ///< of the accepted steps; Newton iterations of the monolithic scheme
  double processor = 0;             ///< s
  std::optional<double> measured;   ///< by which factor a pass multiplies the change of the one before, late in a step
  std::optional<double> predicted;  ///< the same, of the equations of the first step; of schemes without acceleration
  std::optional<double>
      difference;  ///< the largest of any field from the monolithic answer, over the largest value of its unit
  /// By which the page compares values of the scene: `measured`, or `predicted`.
  using Factor = std::optional<double> SchemeResult::*;
  int total_passes() const {
    int sum = 0;
    for (const int count : passes) sum += count;
    return sum;
  }
};

/// The results of a scheme for each value, or each pair of values.
struct AtlasMap {
  std::string scheme;
  std::vector<std::pair<std::string, std::vector<std::string>>> axes;  ///< path, values; one or two
  std::vector<SchemeResult> results;                                   ///< [second][first]; at least one
  bool has_predictions() const { return results.front().scheme.acceleration.empty() && !is_monolithic(); }
  /// "path=value" of each axis at the k-th result.
  std::vector<std::string> values_at(std::size_t k) const {
    const std::size_t width = axes[0].second.size();
    std::vector<std::string> values = {axes[0].first + "=" + axes[0].second[k % width]};
    if (axes.size() > 1) values.push_back(axes[1].first + "=" + axes[1].second[k / width]);
    return values;
  }
  bool is_monolithic() const { return results.front().scheme.is_monolithic(); }
};

}  // namespace sprekk
