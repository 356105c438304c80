#include "framework/assembly/operator.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <utility>

#include "framework/invariants.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

/// Whether the column sums of two matrices agree up to round-off. Always true with several processes, which have only a
/// part of the rows.
[[maybe_unused]] bool columns_add_up_alike(const SparseMatrix& a, const SparseMatrix& b) {
  if (parallel::size() > 1) return true;
  Vector difference = Vector::Zero(a.cols()), size = Vector::Zero(a.cols());
  for (const auto& [matrix, sign] : {std::pair(&a, 1.0), std::pair(&b, -1.0)})
    for (int k = 0; k < matrix->nonZeros(); ++k) {
      difference[matrix->innerIndexPtr()[k]] += sign * matrix->valuePtr()[k];
      size[matrix->innerIndexPtr()[k]] += std::abs(matrix->valuePtr()[k]);
    }
  return (difference.array().abs() <= rounding::same * size.array()).all();
}

}  // namespace

Operator::Operator(SparseMatrix entries) {
  static std::atomic<std::uint64_t> made{0};
  entries.makeCompressed();
  SPREKK_EXPECT(is_well_formed(entries), entries.rows(), entries.cols());
  SPREKK_EXPECT(is_finite(entries), entries.rows(), entries.cols());
  const auto kept = std::make_shared<SparseMatrix>();
  kept->swap(entries);  // Eigen copies sparse matrices when they are moved
  entries_ = kept;
  number_ = ++made;
}

Operator::Operator(SparseMatrix entries, SparseMatrix leaving) : Operator(std::move(entries)) {
  leaving.makeCompressed();
  SPREKK_EXPECT(leaving.rows() == entries_->rows() && leaving.cols() == entries_->cols(), leaving.rows(),
                leaving.cols());
  SPREKK_EXPECT(is_finite(leaving), leaving.rows());
  SPREKK_EXPECT(columns_add_up_alike(*entries_, leaving), leaving.rows(), leaving.cols());
  exchange(std::move(leaving));
}

Operator Operator::between_fields(SparseMatrix entries) {
  Operator made(std::move(entries));
  made.exchange(SparseMatrix(made.entries_->rows(), made.entries_->cols()));
  return made;
}

void Operator::exchange(SparseMatrix leaving) {
  leaving_ = std::make_shared<const SparseMatrix>(std::move(leaving));
  for (int k = 0; k < entries_->nonZeros(); ++k)
    largest_exchange_ = std::max(largest_exchange_, std::abs(entries_->valuePtr()[k]));
}

SparseMatrix diagonal_matrix(const Vector& entries) {
  const int n = static_cast<int>(entries.size());
  SparseMatrix matrix(n, n);
  matrix.resizeNonZeros(n);
  std::iota(matrix.outerIndexPtr(), matrix.outerIndexPtr() + n + 1, 0);
  std::iota(matrix.innerIndexPtr(), matrix.innerIndexPtr() + n, 0);
  std::copy_n(entries.data(), n, matrix.valuePtr());
  return matrix;
}

}  // namespace sprekk
