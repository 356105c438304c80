// The value at a point by a quadratic fit to the values of the cells around it.
#pragma once

#include <utility>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// Cells and weights such that sum of weight · value is a value at `x`: that of the polynomial of second degree that
/// fits best (weighted least squares) the values at the centres of the cells around. It is exact for quadratic fields,
/// and otherwise off by O(h^3). Each corner of `home` has a fit to the cells around it; between the corners the value
/// is interpolated as linear functions on `home` are. So it is continuous from cell to cell, and at a node it does not
/// matter which of the cells there is `home`. Empty where `home` is none.
/// `home`: the cell that holds `x`. The cells around the corner count, and where these are few those next to them. They
/// have to be of the same region, since a field may have a kink where the rock changes, and on the same side of
/// fractures: the line between the centres of `home` and of the cell must not cross one. What the cells cannot tell
/// apart is left out of the polynomial: in a strip of cells it is quadratic along the strip, and with one cell it is a
/// constant.
std::vector<std::pair<int, double>> quadratic_fit(const Mesh& mesh, int home, const Point& x);

}  // namespace sprekk
