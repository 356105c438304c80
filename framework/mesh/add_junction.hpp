// A place where fractures meet, and the points between their cells there.
#pragma once

#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// `end` 0 or 1, as in FractureCell::points.
struct FractureCellEnd {
  int cell, end;
};

/// Adds the junction of those ends, in ascending order of their cells, with a point for each pair of cells. The points
/// between neighbours in a fracture are there already.
void add_junction(Mesh& mesh, const Point& position, const std::vector<FractureCellEnd>& ends);

}  // namespace sprekk
