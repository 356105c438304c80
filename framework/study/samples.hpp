// The samples of a study: values drawn from distributions.
#pragma once

#include <list>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/spec.hpp"

namespace sprekk {

/// An uncertain value of the scene: uniform between two bounds, evenly or in its logarithm, or normal.
struct DistributionOptions {
  std::string path;  ///< in the scene
  Origin origin;
  std::optional<std::string> from, to, mean, deviation;  ///< "1e-17 m^2"
  bool log = false;
  Spec spec();
  /// The value at a share of the distribution, with the unit of its bounds: "3.2e-17 m^2". `share` is strictly between
  /// 0 and 1. Throws InputError for bounds that are no numbers, or of two units.
  std::string value_at(double share) const;
};

/// `samples:` in the file of a study.
struct SampleOptions {
  int count = 0;
  std::string method = "sobol";
  int seed = 1;
  std::list<DistributionOptions> of;
  bool is_given = false;
  Spec spec();
  /// The values of each sample, in the order of `of`. Throws InputError.
  std::vector<std::vector<std::string>> draw() const;
};

}  // namespace sprekk
