// The sum and the product of sparse matrices: Eigen's to the bit, in less memory.
#include "framework/linear/iterative/sparse_sum.hpp"

#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

#include "framework/linear/iterative/sparse_product.hpp"

namespace sprekk {
namespace {

SparseMatrix random_matrix(int rows, int columns, int entries, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  std::vector<Triplet> triplets;
  for (int k = 0; k < entries; ++k)
    triplets.emplace_back(static_cast<int>(engine() % rows), static_cast<int>(engine() % columns), value(engine));
  SparseMatrix a(rows, columns);
  a.setFromTriplets(triplets.begin(), triplets.end());
  return a;
}

void expect_same(const SparseMatrix& a, const SparseMatrix& expected) {
  ASSERT_TRUE(a.isCompressed());
  ASSERT_EQ(a.rows(), expected.rows());
  ASSERT_EQ(a.cols(), expected.cols());
  ASSERT_EQ(a.nonZeros(), expected.nonZeros());
  EXPECT_EQ(a.data().allocatedSize(), a.nonZeros());
  for (int row = 0; row <= a.rows(); ++row) EXPECT_EQ(a.outerIndexPtr()[row], expected.outerIndexPtr()[row]) << row;
  for (int k = 0; k < a.nonZeros(); ++k) {
    EXPECT_EQ(a.innerIndexPtr()[k], expected.innerIndexPtr()[k]) << k;
    EXPECT_EQ(a.valuePtr()[k], expected.valuePtr()[k]) << k;
  }
}

constexpr std::pair<int, int> numbers_of_entries[] = {{400, 300}, {0, 50}, {50, 0}, {0, 0}, {2000, 1}};

TEST(SparseSum, IsThatOfEigenInTheMemoryOfItsEntries) {
  for (const auto& [left, right] : numbers_of_entries) {
    const SparseMatrix a = random_matrix(40, 30, left, 1), b = random_matrix(40, 30, right, 2);
    expect_same(sparse_sum(a, b), a + b);
  }
}

TEST(SparseProduct, IsThatOfEigenInTheMemoryOfItsEntries) {
  for (const auto& [left, right] : numbers_of_entries) {
    const SparseMatrix a = random_matrix(40, 30, left, 3), b = random_matrix(30, 50, right, 4);
    expect_same(sparse_product(a, b), a * b);
  }
}

}  // namespace
}  // namespace sprekk
