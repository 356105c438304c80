#include "framework/linear/iterative/sparse_sum.hpp"

#include "framework/invariants.hpp"

namespace sprekk {
namespace {

/// Calls use(column, value) for the entries of a row of the sum, in their order.
template <class Use>
void for_row(const SparseMatrix& a, const SparseMatrix& b, int row, const Use& use) {
  SparseMatrix::InnerIterator left(a, row), right(b, row);
  while (left || right) {
    if (left && right && left.col() == right.col()) {
      use(left.col(), left.value() + right.value());
      ++left;
      ++right;
    } else if (left && (!right || left.col() < right.col())) {
      use(left.col(), left.value());
      ++left;
    } else {
      use(right.col(), right.value());
      ++right;
    }
  }
}

}  // namespace

SparseMatrix sparse_sum(const SparseMatrix& a, const SparseMatrix& b) {
  SPREKK_EXPECT(a.rows() == b.rows() && a.cols() == b.cols(), a.rows(), b.rows(), a.cols(), b.cols());
  Eigen::Index entries = 0;
  for (int row = 0; row < a.rows(); ++row) for_row(a, b, row, [&](Eigen::Index, double) { ++entries; });
  SparseMatrix sum(a.rows(), a.cols());
  sum.reserve(entries);
  for (int row = 0; row < a.rows(); ++row) {
    sum.startVec(row);
    for_row(a, b, row, [&](Eigen::Index column, double value) { sum.insertBack(row, column) = value; });
  }
  sum.finalize();
  return sum;
}

}  // namespace sprekk
