#include "framework/linear/iterative/sparse_product.hpp"

#include <algorithm>
#include <vector>

#include "framework/invariants.hpp"

namespace sprekk {
namespace {

/// Calls use(column, value) for each product of two entries that belongs to a row.
template <class Use>
void for_products(const SparseMatrix& a, const SparseMatrix& b, int row, const Use& use) {
  for (SparseMatrix::InnerIterator left(a, row); left; ++left)
    for (SparseMatrix::InnerIterator right(b, left.col()); right; ++right)
      use(static_cast<int>(right.col()), left.value() * right.value());
}

}  // namespace

SparseMatrix sparse_product(const SparseMatrix& a, const SparseMatrix& b) {
  SPREKK_EXPECT(a.cols() == b.rows(), a.cols(), b.rows());
  std::vector<int> seen_in(b.cols(), -1);
  Eigen::Index entries = 0;
  for (int row = 0; row < a.rows(); ++row)
    for_products(a, b, row, [&](int column, double) {
      if (seen_in[column] != row) ++entries;
      seen_in[column] = row;
    });
  SparseMatrix product(a.rows(), b.cols());
  product.reserve(entries);
  std::fill(seen_in.begin(), seen_in.end(), -1);
  std::vector<double> values(b.cols());
  std::vector<int> columns;
  for (int row = 0; row < a.rows(); ++row) {
    columns.clear();
    for_products(a, b, row, [&](int column, double value) {
      if (seen_in[column] == row) {
        values[column] += value;
        return;
      }
      seen_in[column] = row;
      values[column] = value;
      columns.push_back(column);
    });
    std::sort(columns.begin(), columns.end());
    product.startVec(row);
    for (const int column : columns) product.insertBack(row, column) = values[column];
  }
  product.finalize();
  return product;
}

}  // namespace sprekk
