// The value at a point of the linear function that fits cell values around it.
#pragma once

#include <utility>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// Cells and weights such that sum of weight · value is the value at `x` of the linear function that fits the values of
/// the cells that share a node with the cell at `x`, in the sense of least squares: exact for linear fields, and a
/// point source spread with these weights has the total and the position of the point. Empty outside of the mesh.
std::vector<std::pair<int, double>> linear_fit(const Mesh& mesh, const Point& x);

}  // namespace sprekk
