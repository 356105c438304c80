#include "framework/assembly/operator.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

namespace sprekk {

Operator::Operator(SparseMatrix entries) {
  static std::atomic<std::uint64_t> made{0};
  entries.makeCompressed();
  const auto kept = std::make_shared<SparseMatrix>();
  kept->swap(entries);  // to move it would copy it
  entries_ = kept;
  number_ = ++made;
}

Operator::Operator(SparseMatrix entries, SparseMatrix leaving) : Operator(std::move(entries)) {
  leaving.makeCompressed();
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
