#include "framework/linear/direct/sparse_lu.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sprekk::test {
namespace {

/// The second difference times `scale`, plus `shift`.
Eigen::SparseMatrix<double> second_difference(int size, double scale, double shift) {
  Eigen::SparseMatrix<double> matrix(size, size);
  for (int i = 0; i < size; ++i) {
    matrix.insert(i, i) = 2 * scale + shift;
    if (i > 0) matrix.insert(i, i - 1) = matrix.insert(i - 1, i) = -scale;
  }
  return matrix;
}

// Its modes are sines, with the eigenvalues scale (2 − 2 cos(k pi / (n + 1))) + shift.
TEST(SparseLu, SolvesForSinesWithTheOrderingOfTheFirstMatrix) {
  constexpr int size = 40;
  SparseLu factors;
  for (const double shift : {0.0, 0.3}) {
    ASSERT_TRUE(factors.factorize(second_difference(size, 2, shift)));
    for (const int k : {1, 7}) {
      const double angle = k * std::numbers::pi / (size + 1);
      Eigen::VectorXd mode(size);
      for (int i = 0; i < size; ++i) mode[i] = std::sin(angle * (i + 1));
      const double eigenvalue = 2 * (2 - 2 * std::cos(angle)) + shift;
      EXPECT_LT((factors.solve(mode) - mode / eigenvalue).norm(), 1e-12 * mode.norm() / eigenvalue);
    }
  }
}

TEST(SparseLu, TellsASingularMatrix) {
  Eigen::SparseMatrix<double> matrix(2, 2);
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) matrix.insert(i, j) = 1;
  SparseLu factors;
  EXPECT_FALSE(factors.factorize(matrix));
}

}  // namespace
}  // namespace sprekk::test
