// The cells that a line passes through.
#pragma once

#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// A straight piece of a line in one cell, m.
struct PieceInCell {
  int cell;
  Point from, to;
};

/// A polyline (two points or more, m) as pieces, each in one cell, in their order. Where it lies in a face, the
/// adjacent cell with the smallest index has it. It may miss a cell of which it cuts off a corner, over less than a
/// quarter of the height of a cell beside it. Throws std::invalid_argument, with the place, where the line leaves the
/// mesh.
std::vector<PieceInCell> line_in_cells(const Mesh& mesh, const std::vector<Point>& line);

}  // namespace sprekk
