// The two ends of an edge, for tables of edges.
#pragma once

#include <algorithm>
#include <array>

namespace sprekk {

/// The smaller number first.
inline std::array<int, 2> sorted(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

}  // namespace sprekk
