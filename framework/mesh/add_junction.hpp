// Adds a place where fractures meet, and the fracture points between the cells that meet there.
#pragma once

#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// One end of a fracture cell; `end` is 0 or 1, as in FractureCell::points.
struct FractureCellEnd {
  int cell, end;
};

/// Adds the junction of the given ends, which are in ascending order of their cells, with a fracture point for each
/// pair of cells. Points between neighbours in a fracture exist already.
void add_junction(Mesh& mesh, const Point& position, const std::vector<FractureCellEnd>& ends);

}  // namespace sprekk
