// The few types that every file shares.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <string>

namespace sprekk {

using Vector = Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;
using Triplet = Eigen::Triplet<double, int>;

#ifndef SPREKK_DIMENSION
#define SPREKK_DIMENSION 2
#endif

inline constexpr int dimension = SPREKK_DIMENSION;  ///< of the matrix; fractures have one less
static_assert(dimension == 2 || dimension == 3);
/// Names of the coordinates: x and y, in space also z. The last one points up.
inline constexpr std::array<const char*, dimension> axis_names = [] {
  std::array<const char*, dimension> names{"x", "y"};
  if (dimension == 3) names.back() = "z";
  return names;
}();
inline constexpr int vertical = dimension - 1;                                ///< the axis that points up
inline constexpr int symmetric_components = dimension * (dimension + 1) / 2;  ///< of a symmetric tensor
/// The two axes of each component of a symmetric tensor: xx, yy, xy; in space xx, yy, zz, xy, yz, xz.
inline constexpr std::array<std::array<int, 2>, symmetric_components> symmetric_axes = [] {
  std::array<std::array<int, 2>, symmetric_components> axes{};
  for (int k = 0; k < symmetric_components; ++k) {
    const int other = k - dimension;
    axes[k] = k < dimension ? std::array{k, k} : std::array{other % 3 == 2 ? 0 : other, other % 3 == 2 ? 2 : other + 1};
  }
  return axes;
}();

using Point = Eigen::Matrix<double, dimension, 1>;
using Tensor = Eigen::Matrix<double, dimension, dimension>;
/// "x, y", in space "x, y, z".
inline std::string axes_text() { return dimension == 2 ? "x, y" : "x, y, z"; }
/// "xx", "yy", …: of component k.
inline std::string symmetric_name(int k) {
  return std::string(axis_names[symmetric_axes[k][0]]) + axis_names[symmetric_axes[k][1]];
}
/// The components of a symmetric tensor, the diagonal first (symmetric_axes).
using SymmetricTensor = Eigen::Matrix<double, symmetric_components, 1>;
/// The components of a vector along the tangents of a fracture cell.
using TangentialVector = Eigen::Matrix<double, dimension - 1, 1>;
/// The unit tangents of a fracture cell, a column each; in a plane one, so that it is a Point.
using Tangents = Eigen::Matrix<double, dimension, dimension - 1>;

}  // namespace sprekk
