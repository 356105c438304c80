#include "framework/linear/eliminate.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>
#include <utility>
#include <vector>

namespace sprekk {
namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Rows random_rows(int n, int width, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  Rows rows(n, width);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < width; ++j) rows(i, j) = (i + j) % 3 == 0 ? 0 : value(random);
  return rows;
}

/// One column after the other; otherwise as eliminate.
void eliminate_one_by_one(Rows& rows) {
  const int n = static_cast<int>(rows.rows()), width = static_cast<int>(rows.cols());
  for (int i = 0; i < n; ++i) {
    const double scale = 1 / rows.row(i).head(n).lpNorm<Eigen::Infinity>();
    rows.row(i) *= scale;
  }
  for (int k = 0; k < n; ++k) {
    int best = k;
    for (int i = k + 1; i < n; ++i)
      if (std::abs(rows(i, k)) > std::abs(rows(best, k))) best = i;
    if (std::abs(rows(k, k)) > 0.05 * std::abs(rows(best, k))) best = k;
    if (best != k) rows.row(k).swap(rows.row(best));
    const double inverse = 1 / rows(k, k);
    for (int j = k + 1; j < width; ++j) rows(k, j) *= inverse;
    for (int i = k + 1; i < n; ++i)
      for (int j = k + 1; j < width; ++j) rows(i, j) -= rows(i, k) * rows(k, j);
  }
  for (int k = n - 1; k > 0; --k)
    for (int i = 0; i < k; ++i)
      for (int j = n; j < width; ++j) rows(i, j) -= rows(i, k) * rows(k, j);
}

TEST(Eliminate, SolvesAndHasTheBitsOfOneColumnAfterTheOther) {
  for (const int n : {1, 2, 3, 4, 5, 8, 13, 30})
    for (unsigned seed = 1; seed < 4; ++seed) {
      const Rows given = random_rows(n, n + 7, seed) + 0.02 * Rows::Identity(n, n + 7);
      Rows solved = given, expected = given;
      ASSERT_GT(eliminate(solved.data(), n, n + 7), 0) << n;
      eliminate_one_by_one(expected);
      EXPECT_EQ(solved.rightCols(7), expected.rightCols(7)) << n;
      const Rows rest = given.leftCols(n) * solved.rightCols(7) - given.rightCols(7);
      EXPECT_LT(rest.lpNorm<Eigen::Infinity>(), 1e-9 * (1 + solved.rightCols(7).lpNorm<Eigen::Infinity>())) << n;
    }
}

TEST(Eliminate, SaysThatAMatrixIsSingular) {
  Rows rows = random_rows(6, 8, 1);
  rows.row(4).head(6) = 2 * rows.row(1).head(6);
  EXPECT_LT(eliminate(rows.data(), 6, 8), 1e-14);
}

}  // namespace
}  // namespace sprekk
