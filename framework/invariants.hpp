// What assertions ask of numbers and lists, as questions. Each looks at every entry: for assertions only.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <ranges>

#include "framework/assert.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// 0 <= index < count.
constexpr bool is_index(long index, long count) { return index >= 0 && index < count; }

template <std::ranges::range Indices>
bool are_indices(const Indices& indices, long count) {
  return std::ranges::all_of(indices, [&](const auto& index) { return is_index(static_cast<long>(index), count); });
}

/// Each is greater than the one before.
template <std::ranges::range Values>
bool is_ascending(const Values& values) {
  return std::ranges::adjacent_find(values, std::greater_equal<>()) == std::ranges::end(values);
}

template <class Derived>
bool is_finite(const Eigen::DenseBase<Derived>& values) {
  return values.allFinite();
}

inline bool is_finite(const SparseMatrix& matrix) {
  for (long k = 0; k < static_cast<long>(matrix.nonZeros()); ++k)
    if (!std::isfinite(matrix.valuePtr()[k])) return false;
  return true;
}

/// How far rounding may take values apart that ought to be equal, of the larger of the two; with much room.
inline constexpr double nearly_equal = 1e-9;

/// Has length one.
template <class Derived>
bool is_unit(const Eigen::MatrixBase<Derived>& vector) {
  return std::abs(vector.norm() - 1) < nearly_equal;
}

/// Up to a round-off of the largest entry.
template <class Derived>
bool is_symmetric(const Eigen::MatrixBase<Derived>& matrix, double tolerance = nearly_equal) {
  if (matrix.rows() != matrix.cols()) return false;
  if (matrix.size() == 0) return true;
  return (matrix - matrix.transpose()).cwiseAbs().maxCoeff() <= tolerance * matrix.cwiseAbs().maxCoeff();
}

/// Rows are compressed, their column indices ascending and in range.
inline bool is_well_formed(const SparseMatrix& matrix) {
  if (!matrix.isCompressed()) return false;
  for (int row = 0; row < matrix.outerSize(); ++row)
    for (int k = matrix.outerIndexPtr()[row]; k < matrix.outerIndexPtr()[row + 1]; ++k) {
      if (!is_index(matrix.innerIndexPtr()[k], matrix.cols())) return false;
      if (k > matrix.outerIndexPtr()[row] && matrix.innerIndexPtr()[k] <= matrix.innerIndexPtr()[k - 1]) return false;
    }
  return true;
}

}  // namespace sprekk
