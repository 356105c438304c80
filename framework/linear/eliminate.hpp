// Elimination in small dense systems, without any allocation.
#pragma once

#include <algorithm>
#include <cmath>

#include "framework/invariants.hpp"

namespace sprekk {

/// Solves A X = B in place by Gaussian elimination with scaled rows. `system` holds the n rows of [A B], `width` values
/// each; the last width - n columns become X. Returns the smallest pivot relative to the largest coefficient of its
/// row, 0 for a singular matrix, in which case X is meaningless.
///
/// Rows are exchanged only if the diagonal is below a twentieth of the largest entry of its column. Balances of media
/// whose coefficients differ by many orders stay accurate row by row when each row is eliminated by its own unknown:
/// then no large multiple of another medium's balance is added and subtracted again.
inline double eliminate(double* system, int n, int width) {
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
  for (int k = 0; k < n; ++k) {
    int best = k;
    for (int i = k + 1; i < n; ++i)
      if (std::abs(system[i * width + k]) > std::abs(system[best * width + k])) best = i;
    if (std::abs(system[k * width + k]) > large_enough * std::abs(system[best * width + k])) best = k;
    double* pivot_row = system + k * width;
    if (best != k) std::swap_ranges(pivot_row + k, pivot_row + width, system + best * width + k);
    const double pivot = pivot_row[k];
    smallest = std::min(smallest, std::abs(pivot));
    if (!(std::abs(pivot) > 0)) return 0;
    const double inverse = 1 / pivot;
    for (int j = k + 1; j < width; ++j) pivot_row[j] *= inverse;
    for (int i = k + 1; i < n; ++i) {
      double* row = system + i * width;
      const double factor = row[k];
      if (factor == 0) continue;
      for (int j = k + 1; j < width; ++j) row[j] -= factor * pivot_row[j];
    }
  }
  for (int k = n - 1; k > 0; --k) {
    const double* solved = system + k * width;
    for (int i = 0; i < k; ++i) {
      double* row = system + i * width;
      const double factor = row[k];
      if (factor == 0) continue;
      for (int j = n; j < width; ++j) row[j] -= factor * solved[j];
    }
  }
  return smallest;
}

}  // namespace sprekk
