// When a run writes its next checkpoint.
#pragma once

#include <algorithm>
#include <optional>

namespace sprekk {

/// s of wall time between two checkpoints: what the user asks for; otherwise a twentieth of the time since the start,
/// at least a minute and at most ten, but so long that writing (the last took `cost` s) takes no more than a twentieth
/// of the time.
inline double checkpoint_interval(const std::optional<double>& given, double since_start, double cost) {
  constexpr double part = 0.05, shortest = 60, longest = 600;
  return given ? *given : std::max(std::clamp(part * since_start, shortest, longest), cost / part);
}

}  // namespace sprekk
