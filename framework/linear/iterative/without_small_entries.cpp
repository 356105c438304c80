#include "framework/linear/iterative/without_small_entries.hpp"

#include <algorithm>
#include <cmath>

#include "framework/invariants.hpp"
#include "framework/linear/refined_solve.hpp"

namespace sprekk {

SparseMatrix without_small_entries(const SparseMatrix& rows, const std::vector<int>& ids) {
  SPREKK_EXPECT(static_cast<Eigen::Index>(ids.size()) == rows.rows() && are_indices(ids, rows.cols()), ids.size());
  // Of the smaller diagonal: measured: 25 iterations instead of 21, and a fifth of the set-up.
  constexpr double small = 1e-3;
  constexpr double least_left = 0.5;  // of the diagonal of a row
  Vector own(rows.rows());
  for (int row = 0; row < rows.rows(); ++row) own[row] = rows.coeff(row, ids[row]);
  const Vector diagonal = whole_vector(ids, own, static_cast<int>(rows.cols()));

  SparseMatrix result(rows.rows(), rows.cols());
  result.reserve(rows.nonZeros());
  for (int row = 0; row < rows.rows(); ++row) {
    const auto is_small = [&](const SparseMatrix::InnerIterator& entry) {
      return std::abs(entry.value()) < small * std::min(std::abs(own[row]), std::abs(diagonal[entry.col()]));
    };
    double left_out = 0;
    for (SparseMatrix::InnerIterator entry(rows, row); entry; ++entry)
      if (is_small(entry)) left_out += entry.value();
    const bool stays = std::abs(own[row] + left_out) < least_left * std::abs(own[row]);
    result.startVec(row);
    for (SparseMatrix::InnerIterator entry(rows, row); entry; ++entry)
      if (stays || !is_small(entry))
        result.insertBack(row, entry.col()) = entry.value() + (!stays && entry.col() == ids[row] ? left_out : 0);
  }
  result.finalize();
  return result;
}

}  // namespace sprekk
