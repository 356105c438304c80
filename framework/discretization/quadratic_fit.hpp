// The value at a point by a quadratic fit to the values of the cells around it.
#pragma once

#include <utility>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// Cells and weights such that sum of weight · value is the value at `x` of the polynomial of second degree that fits
/// the values at the centres of the cells around best, in the sense of weighted least squares: exact for fields that
/// are quadratic there, else off by O(h^3). Empty where `home` is none.
///
/// `home`: the cell that holds `x`. Cells count that share a node with it, and where these are few those next to them;
/// of the same region, since a field may have a kink where the rock changes; and of the same side of fractures: the
/// line between the centres of `home` and of the cell must not cross one. What the cells cannot tell apart is left out
/// of the polynomial: in a row of cells it is quadratic along the row, and with one cell it is a constant.
std::vector<std::pair<int, double>> quadratic_fit(const Mesh& mesh, int home, const Point& x);

}  // namespace sprekk
