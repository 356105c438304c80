// When a run writes its next checkpoint.
#pragma once

#include <algorithm>
#include <optional>

namespace sprekk {

/// The wall time between two checkpoints, s: the interval that the user gives, or else a twentieth of the time since
/// the start, at least one minute and at most ten. Without a given interval it is long enough for writing (the last
/// checkpoint took `cost` s) to take at most a twentieth of the time.
inline double checkpoint_interval(const std::optional<double>& given, double since_start, double cost) {
  constexpr double part = 0.05, shortest = 60, longest = 600;  // of the time; s
  return given ? *given : std::max(std::clamp(part * since_start, shortest, longest), cost / part);
}

}  // namespace sprekk
