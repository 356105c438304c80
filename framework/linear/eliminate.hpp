// Elimination in small dense systems, without any allocation.
#pragma once

#include <algorithm>
#include <cmath>

#include "framework/invariants.hpp"

namespace sprekk {

namespace elimination {

/// How many rows are subtracted from another one in one pass: each pass reads and writes it once.
constexpr int rows_at_once = 4;

/// Subtracts from `row`, between two columns, its multiples of a few rows, in this order.
inline void subtract(double* __restrict__ row, const double* factors, const double* const* rows, int count, int from,
                     int to) {
  if (count == rows_at_once) {
    const double f0 = factors[0], f1 = factors[1], f2 = factors[2], f3 = factors[3];
    const double *r0 = rows[0], *r1 = rows[1], *r2 = rows[2], *r3 = rows[3];
    for (int j = from; j < to; ++j) row[j] = row[j] - f0 * r0[j] - f1 * r1[j] - f2 * r2[j] - f3 * r3[j];
    return;
  }
  for (int k = 0; k < count; ++k) {
    const double factor = factors[k];
    const double* other = rows[k];
    for (int j = from; j < to; ++j) row[j] -= factor * other[j];
  }
}

}  // namespace elimination

/// Solves A X = B in place by Gaussian elimination with scaled rows. `system` holds the n rows of [A B], `width` values
/// each; the last width - n columns become X. Returns the smallest pivot relative to the largest coefficient of its
/// row, 0 for a singular matrix, in which case X is meaningless.
///
/// Rows are exchanged only if the diagonal is below a twentieth of the largest entry of its column. Balances of media
/// whose coefficients differ by many orders stay accurate row by row when each row is eliminated by its own unknown:
/// then no large multiple of another medium's balance is added and subtracted again.
///
/// Columns are eliminated a few at a time, which changes no bit of the result.
inline double eliminate(double* system, int n, int width) {
  using elimination::rows_at_once;
  SPREKK_EXPECT(n > 0 && width >= n, n, width);
  constexpr double large_enough = 0.05;  // of the largest entry of its column: such a diagonal entry stays the pivot
  double smallest = 1;
  for (int i = 0; i < n; ++i) {
    double* row = system + i * width;
    double largest = 0;
    for (int j = 0; j < n; ++j) largest = std::max(largest, std::abs(row[j]));
    if (!(largest > 0)) return 0;
    const double scale = 1 / largest;
    for (int j = 0; j < width; ++j) row[j] *= scale;
  }
  const double* pivots[rows_at_once];
  for (int first = 0; first < n; first += rows_at_once) {
    const int end = std::min(first + rows_at_once, n);
    for (int k = first; k < end; ++k) {
      int best = k;
      for (int i = k + 1; i < n; ++i)
        if (std::abs(system[i * width + k]) > std::abs(system[best * width + k])) best = i;
      if (std::abs(system[k * width + k]) > large_enough * std::abs(system[best * width + k])) best = k;
      double* pivot_row = system + k * width;
      if (best != k) std::swap_ranges(pivot_row + first, pivot_row + width, system + best * width + first);
      const double pivot = pivot_row[k];
      smallest = std::min(smallest, std::abs(pivot));
      if (!(std::abs(pivot) > 0)) return 0;
      // So far only the columns of this pass are up to date.
      elimination::subtract(pivot_row, pivot_row + first, pivots, k - first, end, width);
      const double inverse = 1 / pivot;
      for (int j = k + 1; j < width; ++j) pivot_row[j] *= inverse;
      pivots[k - first] = pivot_row;
      for (int i = k + 1; i < n; ++i) {
        double* row = system + i * width;
        const double factor = row[k];
        if (factor == 0) continue;
        for (int j = k + 1; j < end; ++j) row[j] -= factor * pivot_row[j];
      }
    }
    for (int i = end; i < n; ++i) {
      double* row = system + i * width;
      if (std::all_of(row + first, row + end, [](double factor) { return factor == 0; })) continue;
      elimination::subtract(row, row + first, pivots, end - first, end, width);
    }
  }
  for (int last = n; last > 0; last -= rows_at_once) {
    // Rows from the last one upwards; multiples of those below are subtracted from those above.
    const int begin = std::max(last - rows_at_once, 0);
    for (int k = last - 1; k > begin; --k)
      for (int i = begin; i < k; ++i) {
        const double factor = system[i * width + k];
        if (factor == 0) continue;
        const double* solved = system + k * width;
        double* row = system + i * width;
        for (int j = n; j < width; ++j) row[j] -= factor * solved[j];
      }
    for (int i = 0; i < begin; ++i) {
      double* row = system + i * width;
      double factors[rows_at_once];
      bool is_zero = true;
      for (int k = last - 1; k >= begin; --k) {
        factors[last - 1 - k] = row[k];
        pivots[last - 1 - k] = system + k * width;
        is_zero = is_zero && row[k] == 0;
      }
      if (!is_zero) elimination::subtract(row, factors, pivots, last - begin, n, width);
    }
  }
  return smallest;
}

}  // namespace sprekk
