// The few types that every file shares.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace sprekk {

using Vector = Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;
using Triplet = Eigen::Triplet<double, int>;

inline constexpr int dimension = 2;  ///< of the matrix; fractures have one less
using Point = Eigen::Matrix<double, dimension, 1>;
using Tensor = Eigen::Matrix<double, dimension, dimension>;

}  // namespace sprekk
