#include "framework/linear/condensed_eigenpair.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/dense/general_eigen.hpp"
#include "framework/invariants.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

/// y = M^-1 v. False where the solver fails.
bool apply_inverse(LinearSolver& solver, const std::vector<int>& rows, const CondensedUnknowns& unknowns,
                   const Vector& v, Vector& y) {
  Vector right = Vector::Zero(static_cast<Eigen::Index>(rows.size())), x;
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    const auto place = std::lower_bound(rows.begin(), rows.end(), unknowns.rows[i]);
    if (place != rows.end() && *place == unknowns.rows[i]) right[place - rows.begin()] = unknowns.factors[i] * v[i];
  }
  if (!solver.solve(right, x).solved) return false;
  y.resize(v.size());
  for (Eigen::Index i = 0; i < v.size(); ++i) y[i] = x[unknowns.columns[i]];
  return is_finite(y);
}

/// A vector that is orthogonal to no smooth one, the same in each run.
Vector first_vector(Eigen::Index size) {
  Vector v(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const double turns = static_cast<double>(i + 1) * (std::numbers::phi - 1);  // repeat nowhere
    v[i] = 0.5 + turns - std::floor(turns);
  }
  return v.normalized();
}

/// Arnoldi's method for M^-1: its Hessenberg matrix over an orthonormal basis, one back-solve a vector.
class Arnoldi {
 public:
  Arnoldi(LinearSolver& solver, const std::vector<int>& rows, int size, const CondensedUnknowns& unknowns)
      : solver_(solver), rows_(rows), unknowns_(unknowns), n_(unknowns.factors.size()) {
    SPREKK_EXPECT(unknowns.rows.size() == unknowns.columns.size() && std::ssize(unknowns.rows) == n_,
                  unknowns.rows.size(), unknowns.columns.size(), n_);
    for (Eigen::Index i = 0; i < n_; ++i)
      SPREKK_EXPECT(is_index(unknowns.rows[i], size) && is_index(unknowns.columns[i], size), unknowns.rows[i], size);
    constexpr int most = 40;  // vectors of Arnoldi's method
    const Eigen::Index vectors = std::min<Eigen::Index>(n_, most);
    basis_.resize(n_, vectors);
    hessenberg_ = Eigen::MatrixXd::Zero(vectors, vectors);
    if (n_ > 0) basis_.col(0) = first_vector(n_);
  }

  /// Whether the vectors span an invariant subspace, or there may be no more of them.
  bool is_at_end() const { return is_invariant_ || used_ == basis_.cols(); }

  /// One vector more. False where the solver fails.
  bool extend() {
    if (used_ > 0) {
      hessenberg_(used_, used_ - 1) = left_;
      basis_.col(used_) = next_ / left_;
    }
    if (!apply_inverse(solver_, rows_, unknowns_, basis_.col(used_), next_)) return false;
    const double length = next_.norm();
    for (int twice = 0; twice < 2; ++twice) {
      const Vector parts = basis_.leftCols(used_ + 1).transpose() * next_;
      hessenberg_.col(used_).head(used_ + 1) += parts;
      next_ -= basis_.leftCols(used_ + 1) * parts;
    }
    left_ = next_.norm();
    ++used_;
    is_invariant_ = left_ <= rounding::of_terms * length || used_ == n_;
    if (is_invariant_) left_ = 0;
    return true;
  }

  std::vector<RealEigenpair> pairs() const { return real_eigenpairs(hessenberg_.topLeftCorner(used_, used_)); }
  double residual(const RealEigenpair& pair) const { return left_ * std::abs(pair.vector[used_ - 1]); }
  Vector vector(const RealEigenpair& pair) const { return basis_.leftCols(used_) * pair.vector; }

 private:
  LinearSolver& solver_;
  const std::vector<int>& rows_;
  const CondensedUnknowns& unknowns_;
  Eigen::Index n_, used_ = 0;
  Eigen::MatrixXd basis_, hessenberg_;
  Vector next_;
  double left_ = 0;
  bool is_invariant_ = false;
};

}  // namespace

std::optional<CondensedEigenpair> negative_eigenpair(LinearSolver& solver, const std::vector<int>& rows, int size,
                                                     const CondensedUnknowns& unknowns) {
  constexpr double certain = 0.5;  // of the eigenvalue: its residual, at which its sign is certain
  Arnoldi arnoldi(solver, rows, size, unknowns);
  std::optional<CondensedEigenpair> found;
  if (unknowns.factors.size() == 0) return found;
  while (!arnoldi.is_at_end())
    if (!arnoldi.extend()) return std::nullopt;
  for (const RealEigenpair& pair : arnoldi.pairs()) {
    if (pair.value >= 0 || arnoldi.residual(pair) > certain * -pair.value) continue;
    const double value = 1 / pair.value;
    if (!found || value > found->value) found = {value, arnoldi.vector(pair)};
  }
  return found;
}

double smallest_if_positive(LinearSolver& solver, const std::vector<int>& rows, int size,
                            const CondensedUnknowns& unknowns) {
  constexpr int least = 16;      // vectors: with them a loss shows beside motions that are a hundred times as soft
  constexpr double known = 0.1;  // of the eigenvalue: its residual; a bound from below takes it off
  Arnoldi arnoldi(solver, rows, size, unknowns);
  for (int used = 1; !arnoldi.is_at_end(); ++used) {
    if (!arnoldi.extend()) return 0;
    if (used < least && !arnoldi.is_at_end()) continue;
    const std::vector<RealEigenpair> pairs = arnoldi.pairs();
    if (std::ranges::any_of(pairs, [](const RealEigenpair& pair) { return pair.value <= 0; })) return 0;
    const auto largest = std::ranges::max_element(pairs, {}, &RealEigenpair::value);
    if (largest != pairs.end() && arnoldi.residual(*largest) <= known * largest->value)
      return 1 / (largest->value + arnoldi.residual(*largest));
  }
  return 0;
}

}  // namespace sprekk
