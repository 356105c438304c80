// How far fields of two runs are apart, on one mesh or on two.
#pragma once

#include <string>
#include <vector>

#include "framework/results/cell_sampler.hpp"

namespace sprekk {

/// The difference of one array of two grids. For a vector or tensor: of the vectors of its components.
struct FieldDifference {
  std::string array;       ///< "quantity[unit]"
  double mean_square = 0;  ///< SI: root of the mean square, the L2 norm over the root of the size of what is compared
  double largest = 0;      ///< SI; infinite where one grid has a value and the other has none
  std::vector<double> where;  ///< m, two coordinates or three
  double scale = 0;           ///< SI: the range of both grids, the widest of components
};

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
