#include "framework/linear/equilibration.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/framework/linear/test_systems.hpp"

namespace sprekk {
namespace {

bool is_power_of_two(double value) {
  int exponent = 0;
  return std::frexp(value, &exponent) == 0.5;
}

TEST(Equilibration, BringsRowsAndColumnsNearOneByPowersOfTwo) {
  LinearSystem system = test::random_dominant(200, 1);
  const Vector rows = (25 * test::random_vector(200, 2)).array().exp();
  const Vector columns = (25 * test::random_vector(200, 3)).array().exp();
  system.local = rows.asDiagonal() * system.local * columns.asDiagonal();
  const Equilibrated scaled = equilibrate(system);
  ASSERT_TRUE(scaled.mistake.empty()) << scaled.mistake;
  for (int row = 0; row < 200; ++row) {
    EXPECT_TRUE(is_power_of_two(scaled.row_scale[row]));
    EXPECT_TRUE(is_power_of_two(scaled.column_scale[row]));
    const double largest = Vector(scaled.matrix.row(row)).lpNorm<Eigen::Infinity>();
    EXPECT_GE(largest, 0.25);
    EXPECT_LE(largest, 4);
  }
  // Exactly the same numbers, up to their exponents.
  for (int row = 0; row < 200; ++row)
    for (SparseMatrix::InnerIterator entry(scaled.matrix, row); entry; ++entry)
      EXPECT_EQ(entry.value() / scaled.row_scale[row] / scaled.column_scale[entry.col()],
                system.local.coeff(row, static_cast<int>(entry.col())));
}

TEST(Equilibration, LeavesABalancedMatrixAlone) {
  const LinearSystem system = test::poisson(5);
  const Equilibrated scaled = equilibrate(system);
  EXPECT_EQ(scaled.row_scale, Vector::Ones(25));
  EXPECT_EQ(scaled.column_scale, Vector::Ones(25));
}

}  // namespace
}  // namespace sprekk
