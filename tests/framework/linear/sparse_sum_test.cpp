// The sum of sparse matrices: Eigen's to the bit, in less memory.
#include "framework/linear/iterative/sparse_sum.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

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

TEST(SparseSum, IsThatOfEigenInTheMemoryOfItsEntries) {
  for (const auto& [left, right] : {std::pair{400, 300}, {0, 50}, {50, 0}, {0, 0}, {2000, 1}}) {
    const SparseMatrix a = random_matrix(40, 30, left, 1), b = random_matrix(40, 30, right, 2);
    const SparseMatrix expected = a + b, sum = sparse_sum(a, b);
    ASSERT_TRUE(sum.isCompressed());
    ASSERT_EQ(sum.nonZeros(), expected.nonZeros());
    EXPECT_EQ(sum.data().allocatedSize(), sum.nonZeros());
    for (int row = 0; row <= 40; ++row) EXPECT_EQ(sum.outerIndexPtr()[row], expected.outerIndexPtr()[row]) << row;
    for (int k = 0; k < sum.nonZeros(); ++k) {
      EXPECT_EQ(sum.innerIndexPtr()[k], expected.innerIndexPtr()[k]) << k;
      EXPECT_EQ(sum.valuePtr()[k], expected.valuePtr()[k]) << k;
    }
  }
}

}  // namespace
}  // namespace sprekk
