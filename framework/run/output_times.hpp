// When a run writes fields.
#pragma once

#include <vector>

#include "framework/scene/scene.hpp"

namespace sprekk {

/// The times that the scene asks for, and its end.
class OutputTimes {
 public:
  explicit OutputTimes(const Scene& scene);
  const std::vector<double>& all() const { return times_; }  ///< s, in any order
  /// Whether `time` (s) is one of them. The step controller takes times that are as near for one.
  bool contains(double time) const;

 private:
  std::vector<double> times_;
  double tolerance_;  ///< s
};

}  // namespace sprekk
