// The stress of the rock, for pictures and figures of other parts.
#pragma once

#include "framework/types.hpp"

namespace sprekk {

/// Capability: gives the stress of each cell.
class RockStress {
 public:
  static constexpr const char* promise = "gives the stress of the rock";
  virtual ~RockStress() = default;
  /// The mean total stress of each cell, tension positive, Pa, with its components as in symmetric_axes; right on every
  /// process. Before the first step it is the initial stress.
  virtual Vector mean_stress() const = 0;
};

}  // namespace sprekk
