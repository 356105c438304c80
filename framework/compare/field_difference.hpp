// How far fields of two runs are apart, on one mesh or on two.
#pragma once

#include <vector>

#include "framework/compare/compared_field.hpp"
#include "framework/results/cell_sampler.hpp"

namespace sprekk {

/// The differences of all arrays that two grids have.
struct GridDifference {
  bool is_same_mesh = false;
  int compared = 0;  ///< cells of the finer mesh
  int outside = 0;   ///< cells of the finer mesh whose centre the other one does not cover
  std::vector<FieldDifference> fields;
};

/// Compares entity by entity on equal meshes, else at the centres of the cells of the mesh that has more of them.
/// `walls`, `other_walls`: the lines of each grid across which values jump.
GridDifference grid_difference(const Grid& one, const Grid& walls, const Grid& other, const Grid& other_walls);

}  // namespace sprekk
