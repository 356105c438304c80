// Steps of the schedule that learn from time steps.
#pragma once

#include <map>
#include <string>

#include "framework/types.hpp"

namespace sprekk {

/// A step of the schedule that keeps what it has learned in accepted time steps for later ones. A repeated or restarted
/// step finds what the first attempt found.
class StepHistory {
 public:
  virtual ~StepHistory() = default;
  virtual void accepted() = 0;  ///< the time step has been accepted
  virtual void rewound() = 0;   ///< the time step has been taken back
  /// For checkpoints, as those of parts.
  virtual void save(std::map<std::string, Vector>& state) const = 0;
  virtual void restore(const std::map<std::string, Vector>& state) = 0;
};

}  // namespace sprekk
