// Values at a point of a fracture, from the cells around it.
#pragma once

#include <utility>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// Cells and weights, which add up to 1, of the value at a point `x` of a fracture; `cell` holds it. Across a ridge
/// where fractures touch or cross nothing is interpolated.
/// In a plane each centre has the polynomial of second degree through three centres around it. Between two centres the
/// value goes over linearly from one polynomial to the other: it is continuous along the fracture, exact for quadratic
/// values, and otherwise off by O(h^3). Distances are along the fracture, which may have corners. Next to a junction,
/// and to an end, the polynomial is linear, and beyond the last centre it is the value of the cell.
///
/// In space each node of the cell has the linear function that fits the cells around it best. At x these are weighted
/// by the coordinates of x in the cell (Wachspress 1975): continuous along the fracture, exact for linear values, and
/// otherwise off by O(h^2). A row of cells has a slope along the row; a single cell has its value everywhere.
std::vector<std::pair<int, double>> along_fracture(const Mesh& mesh, int cell, const Point& x);

}  // namespace sprekk
