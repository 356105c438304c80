#include "framework/linear/condensed_eigenpair.hpp"

#include <algorithm>
#include <cmath>

#include "framework/dense/general_eigen.hpp"
#include "framework/invariants.hpp"

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
  constexpr double golden_ratio = 0.6180339887498949;
  Vector v(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const double turns = static_cast<double>(i + 1) * golden_ratio;
    v[i] = 0.5 + turns - std::floor(turns);
  }
  return v.normalized();
}

}  // namespace

std::optional<CondensedEigenpair> negative_eigenpair(LinearSolver& solver, const std::vector<int>& rows, int size,
                                                     const CondensedUnknowns& unknowns) {
  const Eigen::Index n = unknowns.factors.size();
  SPREKK_EXPECT(unknowns.rows.size() == unknowns.columns.size() && static_cast<Eigen::Index>(unknowns.rows.size()) == n,
                unknowns.rows.size(), unknowns.columns.size(), n);
  for (Eigen::Index i = 0; i < n; ++i)
    SPREKK_EXPECT(is_index(unknowns.rows[i], size) && is_index(unknowns.columns[i], size), unknowns.rows[i], size);
  if (n == 0) return std::nullopt;
  constexpr int most = 40;             // vectors
  constexpr double invariant = 1e-12;  // what is left of a vector in an invariant subspace
  constexpr double certain = 0.5;      // of the eigenvalue: its residual, at which its sign is certain
  const Eigen::Index vectors = std::min<Eigen::Index>(n, most);
  Eigen::MatrixXd basis(n, vectors), hessenberg = Eigen::MatrixXd::Zero(vectors, vectors);
  basis.col(0) = first_vector(n);
  Eigen::Index used = 0;
  double left = 0;
  while (used < vectors) {
    Vector next;
    if (!apply_inverse(solver, rows, unknowns, basis.col(used), next)) return std::nullopt;
    const double length = next.norm();
    for (int twice = 0; twice < 2; ++twice) {
      const Vector parts = basis.leftCols(used + 1).transpose() * next;
      hessenberg.col(used).head(used + 1) += parts;
      next -= basis.leftCols(used + 1) * parts;
    }
    left = next.norm();
    ++used;
    if (left <= invariant * length) {
      left = 0;
      break;
    }
    if (used == vectors) break;
    hessenberg(used, used - 1) = left;
    basis.col(used) = next / left;
  }
  std::optional<CondensedEigenpair> found;
  for (const RealEigenpair& pair : real_eigenpairs(hessenberg.topLeftCorner(used, used))) {
    const double residual = used == n ? 0 : left * std::abs(pair.vector[used - 1]);
    if (pair.value >= 0 || residual > certain * -pair.value) continue;
    const double value = 1 / pair.value;
    if (!found || value > found->value) found = {value, basis.leftCols(used) * pair.vector};
  }
  return found;
}

}  // namespace sprekk
