#include "framework/linear/logarithmic_scaling.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/framework/linear/test_systems.hpp"

namespace sprekk {
namespace {

double largest_exponent(const SparseMatrix& a) {
  double largest = 0;
  for (int row = 0; row < a.rows(); ++row)
    for (SparseMatrix::InnerIterator entry(a, row); entry; ++entry)
      largest = std::max(largest, std::abs(std::log2(std::abs(entry.value()))));
  return largest;
}

// Entries of one size in units that differ by up to e^50: the scales undo the units, but for powers of two.
TEST(LogarithmicScaling, UndoesUnits) {
  constexpr int n = 200;
  LinearSystem system = test::random_dominant(n, 1);
  for (int row = 0; row < n; ++row)
    for (SparseMatrix::InnerIterator entry(system.local, row); entry; ++entry)
      entry.valueRef() = entry.value() < 0 ? -1 : 1;
  const Vector rows = (25 * test::random_vector(n, 2)).array().exp();
  const Vector columns = (25 * test::random_vector(n, 3)).array().exp();
  system.local = rows.asDiagonal() * system.local * columns.asDiagonal();
  Equilibrated scaled = equilibrate(system);
  ASSERT_TRUE(scaled.mistake.empty()) << scaled.mistake;
  rescale_by_logarithms(scaled);
  EXPECT_LE(largest_exponent(scaled.matrix), 1.5);
  int exponent = 0;
  for (int row = 0; row < n; ++row) {
    EXPECT_EQ(std::frexp(scaled.row_scale[row], &exponent), 0.5);
    EXPECT_EQ(std::frexp(scaled.column_scale[row], &exponent), 0.5);
    for (SparseMatrix::InnerIterator entry(scaled.matrix, row); entry; ++entry)
      EXPECT_EQ(entry.value() / scaled.row_scale[row] / scaled.column_scale[entry.col()],
                system.local.coeff(row, static_cast<int>(entry.col())));
  }
}

TEST(LogarithmicScaling, LargestEntriesAreNearOne) {
  LinearSystem system = test::random_dominant(200, 4);
  Equilibrated scaled = equilibrate(system);
  rescale_by_logarithms(scaled);
  for (int i = 0; i < 200; ++i) {
    EXPECT_LE(Vector(scaled.matrix.row(i)).lpNorm<Eigen::Infinity>(), 2);
    EXPECT_GE(Vector(scaled.matrix.col(i)).lpNorm<Eigen::Infinity>(), 0.5);
  }
}

}  // namespace
}  // namespace sprekk
