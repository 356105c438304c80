#include "framework/linear/near_singular.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>

#include "framework/linear/refined_solve.hpp"
#include "framework/linear/unknown_names.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {
namespace {

// A fixed vector that no structure of a mesh is orthogonal to (splitmix64 of the index).
Vector scattered_unit_vector(int n) {
  Vector v(n);
  for (int i = 0; i < n; ++i) {
    std::uint64_t z = 0x9e3779b97f4a7c15ULL * (static_cast<std::uint64_t>(i) + 1);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    v[i] = static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1;
  }
  return v / v.norm();
}

// Scales to length one; returns the length before.
double normalize(Vector& v) {
  const double length = v.norm();
  if (std::isfinite(length) && length > 0) v /= length;
  return length;
}

}  // namespace

std::string find_singularity(const LinearSystem& system, const SparseMatrix& rows, const SolveInPlace& solve,
                             const SolveInPlace& solve_transposed) {
  constexpr double suspicious = 1e8;  // a singular matrix grows a random vector by 1e16 / sqrt(n), roughly
  constexpr double singular = 3e-15;  // a floating rock shows 1e-16; an open fracture in tight rock has 5e-15
  const int unknowns = static_cast<int>(rows.cols());
  Vector v = scattered_unit_vector(unknowns);
  solve(v);
  if (normalize(v) < suspicious) return "";
  for (int step = 0; step < 2; ++step) {
    solve_transposed(v);
    normalize(v);
    solve(v);
    normalize(v);
  }

  // The factors of a nearly singular matrix may be inaccurate themselves, which hides that it is; A is not. The step
  // v - A^-1 A v leaves a null vector of A as it is and removes the error that the factors put into it.
  double smallest = HUGE_VAL;
  int largest_entry = 0;
  for (int step = 0;; ++step) {
    Vector residual = rows * v;
    const Vector terms = rows.cwiseAbs() * v.cwiseAbs();
    const double ratio = std::sqrt(parallel::sum(residual.squaredNorm()) / parallel::sum(terms.squaredNorm()));
    if (ratio < smallest) {
      smallest = ratio;
      v.cwiseAbs().maxCoeff(&largest_entry);
    }
    if (step == 2) break;
    residual = whole_vector(system.rows, residual, unknowns);
    solve(residual);
    v -= residual;
    normalize(v);
  }
  if (smallest > singular) return "";
  char text[160];
  std::snprintf(text, sizeof text, "the matrix is singular (to a relative change of %.0e; moving ", smallest);
  return text + describe_unknown(system.blocks, largest_entry) + " and its like together disturbs no balance)";
}

}  // namespace sprekk
