// The cells of a line of a grid in their order along the line.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "framework/results/grid.hpp"

namespace sprekk {

/// A path from end to end of a line; a line that branches or is in pieces has several paths.
struct FracturePath {
  std::vector<std::array<double, 2>> points;
  std::vector<int> cells;      ///< one less than points
  std::vector<double> length;  ///< at the middle of each cell, from the origin of the arc length (m)
  double start = 0, end = 0;   ///< at the first and last point (m)
};

/// The origin and direction of the arc length of a line. A line that grows keeps both, so that curves of different
/// times fit to one another: cells that grow at the first end have negative lengths.
struct PathOrigin {
  std::array<double, 2> first, last;
};

/// The paths of the cells `cells` of `grid`, which are lines. `origin` is set by the first call and used by later ones.
/// Points at the same place are one.
std::vector<FracturePath> fracture_paths(const Grid& grid, const std::vector<int>& cells,
                                         std::optional<PathOrigin>& origin);

}  // namespace sprekk
