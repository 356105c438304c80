// How far one field of two runs is apart.
#pragma once

#include <string>
#include <vector>

namespace sprekk {

/// The difference of one array of two grids. For a vector or tensor: of the vectors of its components.
struct FieldDifference {
  std::string array;       ///< "quantity[unit]"
  double mean_square = 0;  ///< SI: root of the mean square, the L2 norm over the root of the size of what is compared
  double largest = 0;      ///< SI; infinite where one grid has a value and the other has none
  std::vector<double> where;  ///< m, two coordinates or three
  double scale = 0;           ///< SI: the range of both grids, the widest of components
};

}  // namespace sprekk
