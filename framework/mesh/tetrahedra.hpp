// Cells in space as tetrahedra.
#pragma once

#include <array>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// A part of a cell: its corners (m), and its volume (m^3).
struct Tetrahedron {
  std::array<Point, 4> corners;
  double volume;
};

/// The parts of a cell: itself, or those between its centre and the triangles of its faces, which are between the edges
/// of a quadrilateral and the mean of its nodes. Their volumes add up to that of the cell.
std::vector<Tetrahedron> tetrahedra_of(const Mesh& mesh, int cell);

}  // namespace sprekk
