#include "framework/linear/direct/near_singular.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "framework/invariants.hpp"
#include "framework/linear/refined_solve.hpp"
#include "framework/linear/unknown_names.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

// A fixed pseudo-random unit vector (splitmix64 of the index), one for each number; no structure of a mesh is
// orthogonal to it.
Vector scattered_unit_vector(int n, int number) {
  SPREKK_EXPECT(n > 0 && number >= 0, n, number);
  Vector v(n);
  for (int i = 0; i < n; ++i) {
    std::uint64_t z = 0x9e3779b97f4a7c15ULL * (static_cast<std::uint64_t>(number) * n + i + 1);
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

void remove_from(Vector& v, const std::vector<Vector>& known) {
  for (const Vector& other : known) v -= other.dot(v) * other;
}

/// The products of the sums of balances with vectors, over the sizes of their terms, a row for each sum: 0 where the
/// terms cancel, up to 1 where they do not. Only columns in which a vector is clearly not zero count, since round-off
/// of the others may exceed the entries of a sum.
Eigen::MatrixXd resistance(const LinearSystem& system, const SparseMatrix& rows, const std::vector<Vector>& vectors) {
  const int sums = static_cast<int>(system.sums.size()), count = static_cast<int>(vectors.size());
  SPREKK_EXPECT(rows.rows() == static_cast<Eigen::Index>(system.rows.size()), rows.rows(), system.rows.size());
  Vector values = Vector::Zero(sums * count), sizes = values;
  for (int s = 0; s < sums; ++s) {
    const auto place = std::lower_bound(system.rows.begin(), system.rows.end(), system.sums[s]);
    if (place == system.rows.end() || *place != system.sums[s]) continue;
    for (int k = 0; k < count; ++k) {
      const double largest = vectors[k].lpNorm<Eigen::Infinity>();
      for (SparseMatrix::InnerIterator entry(rows, place - system.rows.begin()); entry; ++entry) {
        const double moved = vectors[k][entry.col()];
        if (std::abs(moved) < rounding::half_of_digits * largest) continue;
        values[s * count + k] += entry.value() * moved;
        sizes[s * count + k] += std::abs(entry.value() * moved);
      }
    }
  }
  parallel::sum(values);
  parallel::sum(sizes);
  Eigen::MatrixXd result(sums, count);
  for (int s = 0; s < sums; ++s) {
    const double size = sizes.segment(s * count, count).maxCoeff();
    for (int k = 0; k < count; ++k) result(s, k) = size > 0 ? values[s * count + k] / size : 0;
  }
  return result;
}

/// The combination of the vectors for which all sums of balances are zero; empty if there is none.
Vector without_resistance(const LinearSystem& system, const SparseMatrix& rows, const std::vector<Vector>& vectors) {
  constexpr double cancelled = 1e-2;  // of the terms: between round-off and 1
  if (system.sums.empty()) return vectors.back();
  Eigen::FullPivLU<Eigen::MatrixXd> lu(resistance(system, rows, vectors));
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(1);
  if (std::abs(lu.maxPivot()) > cancelled) {
    lu.setThreshold(cancelled / lu.maxPivot());
    if (lu.dimensionOfKernel() == 0) return {};
    weights = lu.kernel().col(0);
  } else {
    weights = Eigen::VectorXd::Unit(vectors.size(), 0);
  }
  Vector v = Vector::Zero(vectors[0].size());
  for (std::size_t k = 0; k < vectors.size(); ++k) v += weights[k] * vectors[k];
  normalize(v);
  return v;
}

/// The largest |A v| of a row over its terms |A| |v|, among rows in which v is noticeable. Where A has a null vector
/// except for the rounding of its entries, this is round-off for it in every row, whatever the scales of rows and
/// columns. A norm alone would take a vector for a null vector that is none in rows which are scaled down. Terms below
/// 1e-4 of the largest do not count, since a vector found by inverse iteration is inaccurate there.
double worst_row(const SparseMatrix& rows, const Vector& v) {
  constexpr double noticeable = 1e-4;  // as above
  const Vector residual = (rows * v).cwiseAbs(), terms = rows.cwiseAbs() * v.cwiseAbs();
  const double largest = parallel::max(terms.size() > 0 ? terms.maxCoeff() : 0.0);
  double worst = 0;
  for (int row = 0; row < terms.size(); ++row)
    if (terms[row] > noticeable * largest) worst = std::max(worst, residual[row] / terms[row]);
  return parallel::max(worst);
}

}  // namespace

std::string find_singularity(const LinearSystem& system, const SparseMatrix& rows, const SolveInPlace& solve,
                             const SolveInPlace& solve_transposed) {
  constexpr double suspicious = 1e8;  // a singular matrix grows a random vector by 1e16 / sqrt(n), roughly
  constexpr double singular = 3e-15;  // a floating rock shows 1e-16; an open fracture in tight rock has 5e-15
  const int unknowns = static_cast<int>(rows.cols());
  std::vector<Vector> resting;  // nearly null vectors, orthogonal to one another
  for (std::size_t number = 0; number <= system.sums.size(); ++number) {
    Vector v = scattered_unit_vector(unknowns, static_cast<int>(number));
    remove_from(v, resting);
    solve(v);
    if (number == 0 && !(v.norm() >= suspicious)) return "";
    remove_from(v, resting);
    normalize(v);
    for (int step = 0; step < 2; ++step) {
      solve_transposed(v);
      normalize(v);
      solve(v);
      remove_from(v, resting);
      normalize(v);
    }

    // The factors of a near-singular matrix may be inaccurate, which hides the singularity; A itself is accurate. The
    // step v - A^-1 A v leaves a null vector of A as it is and removes the error that the factors put into it.
    double smallest = HUGE_VAL;
    Vector best;
    for (int step = 0;; ++step) {
      Vector residual = rows * v;
      const Vector terms = rows.cwiseAbs() * v.cwiseAbs();
      const double ratio = std::sqrt(parallel::sum(residual.squaredNorm()) / parallel::sum(terms.squaredNorm()));
      if (ratio < smallest) {
        smallest = ratio;
        best = v;
      }
      if (step == 2) break;
      residual = whole_vector(system.rows, residual, unknowns);
      solve(residual);
      v -= residual;
      remove_from(v, resting);
      normalize(v);
    }
    if (!(smallest <= singular) || !(worst_row(rows, best) <= rounding::of_terms)) return "";
    resting.push_back(std::move(best));
    const Vector found = without_resistance(system, rows, resting);
    if (found.size() == 0) continue;
    int largest_entry = 0;
    found.cwiseAbs().maxCoeff(&largest_entry);
    char text[160];
    std::snprintf(text, sizeof text, "the matrix is singular (to a relative change of %.0e; moving ", smallest);
    return text + describe_unknown(system.blocks, largest_entry) + " and its like together disturbs no balance)";
  }
  return "";
}

}  // namespace sprekk
