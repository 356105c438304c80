// Straight pieces of fractures, which end at kinks and junctions.
#pragma once

#include "framework/mesh/mesh.hpp"

namespace sprekk::couplers {

/// 1 − cos of the smallest bend that ends a straight piece (1.4e-4 rad): rounding of tangents makes less.
inline constexpr double least_bend = 1e-8;

/// Whether a cell and the next one, cell + 1, are on one straight piece of a fracture.
inline bool is_straight_on(const Mesh& mesh, int cell) {
  if (cell < 0 || cell + 1 >= mesh.fracture_cell_count()) return false;
  const FractureCell &here = mesh.fracture_cells[cell], &next = mesh.fracture_cells[cell + 1];
  return here.fracture == next.fracture && mesh.ridges[here.ridges[1]].kind != Ridge::Kind::junction &&
         here.tangents.dot(next.tangents) > 1 - least_bend;
}

}  // namespace sprekk::couplers
