// The value at a point by a linear fit to the values of the cells around it.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// Cells and weights such that sum of weight · value is a value at `x`: that of the linear function that fits best
/// (least squares) the values of the cells that share a node with the cell at `x`. It is exact for linear fields, and a
/// point source that is spread with these weights has the total and the position of the point. Empty outside of the
/// mesh.
///
/// Only cells of the same region as the cell at `x` count, and of these only cells that is_like(cell at x, cell)
/// accepts: a field may have a kink where the rock changes, and a well must not feed the rock on the other side. With
/// fewer than three cells, or with all centres in a line, the result is the value of the cell at `x`.
std::vector<std::pair<int, double>> linear_fit(const Mesh& mesh, const Point& x,
                                               const std::function<bool(int, int)>& is_like = {});

/// What a source along a polyline (two points or more, m) gives to cells: as much for each metre, spread at each place
/// as linear_fit spreads it there. The weights add up to 1. Throws std::invalid_argument, with the place, where the
/// line leaves the mesh.
std::vector<std::pair<int, double>> line_source(const Mesh& mesh, const std::vector<Point>& line,
                                                const std::function<bool(int, int)>& is_like = {});

}  // namespace sprekk
