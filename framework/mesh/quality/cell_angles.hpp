// Angles of cells.
#pragma once

#include <vector>

#include "framework/mesh/shapes.hpp"

namespace sprekk {

/// The smallest and largest angle of a cell, rad: between neighbouring edges in a plane, between neighbouring faces
/// (dihedral angles) in space; all positive in convex cells of either orientation.
struct AngleRange {
  double smallest, largest;
};
AngleRange angles(const std::vector<Point>& nodes, const CellNodes& cell);

}  // namespace sprekk
