// The few types that every file shares.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace sprekk {

using Vector = Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;
using Triplet = Eigen::Triplet<double, int>;

#ifndef SPREKK_DIMENSION
#define SPREKK_DIMENSION 2
#endif

inline constexpr int dimension = SPREKK_DIMENSION;  ///< of the matrix; fractures have one less
static_assert(dimension == 2 || dimension == 3);
inline constexpr int symmetric_components = dimension * (dimension + 1) / 2;  ///< of a symmetric tensor

using Point = Eigen::Matrix<double, dimension, 1>;
using Tensor = Eigen::Matrix<double, dimension, dimension>;
/// The components of a symmetric tensor, the diagonal first: (xx, yy, xy) in a plane.
using SymmetricTensor = Eigen::Matrix<double, symmetric_components, 1>;
/// The components of a vector along the tangents of a fracture cell.
using TangentialVector = Eigen::Matrix<double, dimension - 1, 1>;
/// The unit tangents of a fracture cell, a column each; in a plane one, so that it is a Point.
using Tangents = Eigen::Matrix<double, dimension, dimension - 1>;

}  // namespace sprekk
