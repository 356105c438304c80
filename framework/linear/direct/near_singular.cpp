#include "framework/linear/direct/near_singular.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "framework/invariants.hpp"
#include "framework/linear/unknown_names.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

// A fixed pseudo-random unit vector (splitmix64 of the index); no structure of a mesh is orthogonal to it.
Vector scattered_unit_vector(int n) {
  SPREKK_EXPECT(n > 0, n);
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

// Terms below this part of the largest do not count, since a vector found by inverse iteration is inaccurate there.
constexpr double noticeable = 1e-4;

/// A system with the terms |A| |v| of a vector, and numbers of any sign that are as large.
class Terms {
 public:
  Terms(const LinearSystem& system, const SparseMatrix& rows, const ApplyInverse& apply_inverse)
      : system_(system),
        rows_(rows),
        apply_inverse_(apply_inverse),
        signs_(scattered_unit_vector(static_cast<int>(rows.cols()))) {}

  Vector of(const Vector& v) const { return rows_.cwiseAbs() * v.cwiseAbs(); }

  /// The largest |A v| of a row over its terms, in rows with noticeable terms. Where A has a null vector except for the
  /// rounding of its entries, this is round-off for it in every row.
  double worst_row(const Vector& v) const {
    const Vector residual = (rows_ * v).cwiseAbs(), terms = of(v);
    const double least = noticeable * largest(terms);
    double worst = 0;
    for (int row = 0; row < terms.size(); ++row)
      if (terms[row] > least) worst = std::max(worst, residual[row] / terms[row]);
    return parallel::max(worst);
  }

  /// x of A x = b with b as large as the terms of v above `least` times the largest, and 0 elsewhere.
  Vector response(const Vector& v, double least) const {
    Vector b = of(v);
    least *= largest(b);
    for (int row = 0; row < b.size(); ++row)
      b[row] = b[row] > least ? std::copysign(b[row], signs_[system_.rows[row]]) : 0;
    Vector x = solved(b);
    x += solved(b - rows_ * x);  // factors of a matrix that is nearly singular may be inaccurate
    normalize(x);
    return x;
  }

 private:
  double largest(const Vector& terms) const { return parallel::max(terms.size() > 0 ? terms.maxCoeff() : 0.0); }
  Vector solved(Vector b) const {
    apply_inverse_(b);
    return b;
  }

  const LinearSystem& system_;
  const SparseMatrix& rows_;
  const ApplyInverse& apply_inverse_;
  Vector signs_;
};

}  // namespace

std::string find_singularity(const LinearSystem& system, const SparseMatrix& rows, const ApplyInverse& apply_inverse) {
  constexpr double suspicious = 1e8;  // a singular matrix grows a random vector by 1e16 / sqrt(n), roughly
  constexpr double singular = 3e-15;  // a floating rock shows 1e-16; an open fracture in tight rock has 5e-15
  Vector v = scattered_unit_vector(static_cast<int>(rows.cols()))(system.rows);
  apply_inverse(v);
  if (!(v.norm() >= suspicious)) return "";
  normalize(v);
  // A vector that grows may be null in some scales of rows and columns only. Where forces as large as its terms are
  // given, a null vector still grows by all digits, and others do not, in all scales: the response is then the null
  // vector alone. Twice, since what does not grow is as large as before.
  const Terms terms(system, rows, apply_inverse);
  v = terms.response(v, 0);
  v = terms.response(v, noticeable);  // a null vector shows 1e-11 at most below, others 0.1
  if (!(terms.worst_row(v) <= rounding::half_of_digits)) return "";

  // The step v - A^-1 A v leaves a null vector of A as it is and removes the error that the factors put into it.
  double smallest = HUGE_VAL;
  Vector best;
  for (int step = 0;; ++step) {
    Vector residual = rows * v;
    const double ratio = std::sqrt(parallel::sum(residual.squaredNorm()) / parallel::sum(terms.of(v).squaredNorm()));
    if (ratio < smallest) {
      smallest = ratio;
      best = v;
    }
    if (step == 2) break;
    apply_inverse(residual);
    v -= residual;
    normalize(v);
  }
  if (!(smallest <= singular) || !(terms.worst_row(best) <= rounding::of_terms)) return "";
  int largest_entry = 0;
  best.cwiseAbs().maxCoeff(&largest_entry);
  char text[160];
  std::snprintf(text, sizeof text, "the matrix is singular (to a relative change of %.0e; moving ", smallest);
  return text + describe_unknown(system.blocks, largest_entry) + " and its like together disturbs no balance)";
}

}  // namespace sprekk
