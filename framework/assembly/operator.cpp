#include "framework/assembly/operator.hpp"

#include <algorithm>
#include <atomic>
#include <numeric>

namespace sprekk {

Operator::Operator(SparseMatrix entries) {
  static std::atomic<std::uint64_t> made{0};
  entries.makeCompressed();
  entries_ = std::make_shared<const SparseMatrix>(std::move(entries));
  number_ = ++made;
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
