// Weights of the corners of a cell.
#pragma once

#include <utility>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// The corners (nodes) of a convex cell and weights such that sum of weight · value at the corner is the value at `x`:
/// exact for linear functions; linear along faces, so that neighbours agree there; not negative in the cell and 1 in
/// all. In triangles they are the barycentric coordinates, in quadrilaterals those of Wachspress (1975, A Rational
/// Finite Element Basis).
std::vector<std::pair<int, double>> corner_weights(const Mesh& mesh, int cell, const Point& x);

/// The cell among `cells` that contains x, or comes nearest to it: the one whose smallest distance from x to the lines
/// of its faces (negative outside) is largest; the first of equal ones. `cells` are not empty.
int cell_holding(const Mesh& mesh, const std::vector<int>& cells, const Point& x);

}  // namespace sprekk
