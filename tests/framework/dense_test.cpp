// Decompositions of dense matrices, against what defines them.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/dense/cholesky.hpp"
#include "framework/dense/least_squares.hpp"
#include "framework/dense/lu.hpp"
#include "framework/dense/symmetric_eigen.hpp"

namespace sprekk::test {
namespace {

constexpr double round_off = 1e-13;

/// 1 / (i + k + 1), and 1 more on the diagonal: symmetric and positive definite.
Eigen::MatrixXd symmetric(int size) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(size, size);
  for (int i = 0; i < size; ++i)
    for (int k = 0; k < size; ++k) matrix(i, k) += 1.0 / (i + k + 1);
  return matrix;
}

/// The same with other signs above the diagonal.
Eigen::MatrixXd unsymmetric(int size) {
  Eigen::MatrixXd matrix = symmetric(size);
  matrix.triangularView<Eigen::StrictlyUpper>() *= -1;
  return matrix;
}

TEST(Dense, LuSolvesForOneAndForManyRightSides) {
  const Eigen::MatrixXd matrix = unsymmetric(40), exact = symmetric(40).leftCols(3);
  const Eigen::MatrixXd right = matrix * exact;
  EXPECT_LT((DenseLu(matrix).solve_columns(right) - exact).norm(), round_off * exact.norm());
  EXPECT_LT((DenseLu(matrix).solve(right.col(1)) - exact.col(1)).norm(), round_off * exact.norm());
  const FullPivotingLu full(matrix);
  EXPECT_TRUE(full.is_invertible());
  EXPECT_LT((full.solve_columns(right) - exact).norm(), round_off * exact.norm());
  EXPECT_LT((full.solve(right.col(1)) - exact.col(1)).norm(), round_off * exact.norm());
  EXPECT_LT((full.inverse() * matrix - Eigen::MatrixXd::Identity(40, 40)).norm(), 40 * round_off);
}

TEST(Dense, FullPivotingSeesASingularMatrix) {
  Eigen::MatrixXd matrix = unsymmetric(5);
  matrix.col(4) = matrix.col(0) + matrix.col(1);
  EXPECT_FALSE(FullPivotingLu(matrix).is_invertible());
}

// The pseudo-inverse is the only matrix with these four properties (Penrose 1955).
TEST(Dense, PseudoInverseOfDeficientRank) {
  Eigen::MatrixXd matrix = unsymmetric(7).leftCols(4);
  matrix.col(3) = matrix.col(0) - 2 * matrix.col(2);
  const LeastSquares fit(matrix);
  EXPECT_EQ(fit.rank(), 3);
  const Eigen::MatrixXd inverse = fit.pseudo_inverse();
  EXPECT_LT((matrix * inverse * matrix - matrix).norm(), round_off);
  EXPECT_LT((inverse * matrix * inverse - inverse).norm(), round_off);
  EXPECT_LT((matrix * inverse - (matrix * inverse).transpose()).norm(), round_off);
  EXPECT_LT((inverse * matrix - (inverse * matrix).transpose()).norm(), round_off);
  const Eigen::MatrixXd right = symmetric(7).leftCols(2);
  EXPECT_LT((fit.solve_columns(right) - inverse * right).norm(), round_off);
  EXPECT_LT((fit.solve(right.col(1)) - inverse * right.col(1)).norm(), round_off);
}

TEST(Dense, ThresholdDecidesTheRank) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(3, 3);
  matrix(2, 2) = 1e-4;
  EXPECT_EQ(LeastSquares(matrix).rank(), 3);
  EXPECT_EQ(LeastSquares(matrix, 1e-3).rank(), 2);
}

// A polynomial of degree 2 through five of its values.
TEST(Dense, PivotedQrFitsExactly) {
  Eigen::MatrixXd matrix(5, 3);
  for (int i = 0; i < 5; ++i) matrix.row(i) << 1, i, i * i;
  const Eigen::Vector3d exact(2, -1, 0.5);
  EXPECT_LT((solve_by_pivoted_qr(matrix, matrix * exact) - exact).norm(), 10 * round_off);
}

TEST(Dense, ThinQrHasTheNormalEquationsOfItsMatrix) {
  for (const Eigen::MatrixXd& matrix : {Eigen::MatrixXd(symmetric(7).leftCols(3)), Eigen::MatrixXd(unsymmetric(5))}) {
    const ThinQr qr = thin_qr(matrix);
    const Eigen::Index count = std::min(matrix.rows(), matrix.cols());
    EXPECT_LT((qr.q * qr.r - matrix).norm(), round_off * matrix.norm());
    EXPECT_LT((qr.q.transpose() * qr.q - Eigen::MatrixXd::Identity(count, count)).norm(), round_off);
    EXPECT_EQ(Eigen::MatrixXd(qr.r.triangularView<Eigen::StrictlyLower>()).norm(), 0);
    const Eigen::MatrixXd exact = unsymmetric(static_cast<int>(matrix.cols()));
    EXPECT_LT((solve_by_qr(matrix, matrix * exact) - exact).norm(), 100 * round_off * exact.norm());
  }
}

TEST(Dense, CholeskySolvesOrRefuses) {
  const Eigen::MatrixXd matrix = symmetric(12), exact = unsymmetric(12).leftCols(2);
  const DenseCholesky factors(matrix);
  EXPECT_TRUE(factors.is_positive_definite());
  EXPECT_LT((factors.solve_columns(matrix * exact) - exact).norm(), round_off * exact.norm());
  EXPECT_FALSE(DenseCholesky(-matrix).is_positive_definite());
}

// The second difference has the eigenvalues 2 − 2 cos(k pi / (n + 1)).
TEST(Dense, EigenvaluesOfTheSecondDifference) {
  constexpr int size = 9;
  Eigen::MatrixXd matrix = 2 * Eigen::MatrixXd::Identity(size, size);
  for (int i = 1; i < size; ++i) matrix(i, i - 1) = matrix(i - 1, i) = -1;
  const SymmetricEigen found = symmetric_eigen(matrix);
  const Eigen::VectorXd values = symmetric_eigenvalues(matrix);
  for (int k = 0; k < size; ++k) {
    const double exact = 2 - 2 * std::cos((k + 1) * std::numbers::pi / (size + 1));
    EXPECT_NEAR(found.values[k], exact, round_off);
    EXPECT_NEAR(values[k], exact, round_off);
    EXPECT_LT((matrix * found.vectors.col(k) - exact * found.vectors.col(k)).norm(), 10 * round_off);
  }
}

// A x = λ B x with A = L D L^T and B = L L^T has the entries of D.
TEST(Dense, GeneralizedEigenvaluesOfAProduct) {
  const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(4, 4) + 0.1 * unsymmetric(4);
  const Eigen::Vector4d exact(-1, 0.5, 2, 7);
  const Eigen::VectorXd found =
      generalized_eigenvalues(left * exact.asDiagonal() * left.transpose(), left * left.transpose());
  EXPECT_LT((found - exact).norm(), 10 * round_off * exact.norm());
}

}  // namespace
}  // namespace sprekk::test
