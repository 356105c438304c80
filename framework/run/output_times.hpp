// When a run writes fields.
#pragma once

#include <vector>

#include "framework/scene/scene.hpp"

namespace sprekk {

/// The times at which a scene asks for fields, and the end of the run.
class OutputTimes {
 public:
  explicit OutputTimes(const Scene& scene);
  const std::vector<double>& all() const { return times_; }  ///< s, in any order
  /// Whether `time` (s) is one of them, to the tolerance to which the step controller takes two times for one.
  bool contains(double time) const;

 private:
  std::vector<double> times_;
  double tolerance_;  ///< s
};

}  // namespace sprekk
