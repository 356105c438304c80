// Parts that tell how much they have done.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/assembly/part.hpp"

namespace sprekk {

/// Capability: entries of the end-of-run table.
class CountsWork {
 public:
  virtual ~CountsWork() = default;
  /// How often something was computed or reused: name → count.
  virtual std::map<std::string, long> counts() const = 0;
  /// The part's own work inside of steps, without the work of the schedule's solvers.
  virtual std::vector<ProfileEntry> efforts() const { return {}; }
};

}  // namespace sprekk
