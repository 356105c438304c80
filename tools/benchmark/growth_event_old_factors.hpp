// Solutions on a changed mesh from the factorization of the mesh before: exact in rows, or as a preconditioner.
#pragma once

#include <Eigen/LU>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "framework/linear/equilibration.hpp"
#include "tools/benchmark/growth_event_bulk.hpp"

namespace sprekk::growth_event {

/// Per unknown of `after` the same one of `before`, or none.
inline std::vector<int> origins(const Bulk& before, const Bulk& after) {
  std::map<std::tuple<int, double, double>, int> known;
  for (int j = 0; j < before.size(); ++j) known[{before.kind[j], before.place[j].x(), before.place[j].y()}] = j;
  std::vector<int> origin(after.size(), none);
  for (int i = 0; i < after.size(); ++i)
    if (const auto found = known.find({after.kind[i], after.place[i].x(), after.place[i].y()}); found != known.end())
      origin[i] = found->second;
  return origin;
}

/// The rows of `after` that are not, entry by entry, rows of `before`.
inline std::vector<int> changed_rows(const Bulk& before, const Bulk& after, const std::vector<int>& origin) {
  std::vector<int> changed;
  for (int i = 0; i < after.size(); ++i) {
    std::map<int, double> now, was;
    bool is_new = origin[i] == none;
    for (SparseMatrix::InnerIterator entry(after.system.local, i); entry && !is_new; ++entry) {
      is_new = origin[entry.col()] == none;
      now[origin[entry.col()]] = entry.value();
    }
    if (!is_new)
      for (SparseMatrix::InnerIterator entry(before.system.local, origin[i]); entry; ++entry)
        was[static_cast<int>(entry.col())] = entry.value();
    if (is_new || now != was) changed.push_back(i);
  }
  return changed;
}

/// The factorization before, for vectors of the mesh after: what is new is left alone, what is gone is zero.
struct Old {
  const Bulk& before;
  const std::vector<int>& origin;

  Eigen::MatrixXd solve(const Eigen::MatrixXd& columns) const {
    Eigen::MatrixXd old = Eigen::MatrixXd::Zero(before.size(), columns.cols()), result = columns;
    for (int i = 0; i < columns.rows(); ++i)
      if (origin[i] != none) old.row(origin[i]) = columns.row(i);
    if (columns.cols() == 1)
      before.solver.solve_unchecked(old.col(0));
    else
      const_cast<UmfpackSolver&>(before.solver).solve_columns(old);
    for (int i = 0; i < columns.rows(); ++i)
      if (origin[i] != none) result.row(i) = old.row(origin[i]);
    return result;
  }
};

/// A x = b, from A = (old rows) + (changed rows): x = M^-1 (b + P y), with P the changed rows and y such that they
/// hold. Returns the largest relative residual; rows in the scaling of `scaled`.
inline double solve_by_rows(const Old& old, const std::vector<int>& changed, const Bulk& after,
                            const Equilibrated& scaled) {
  const int n = after.size(), m = static_cast<int>(changed.size());
  SparseMatrix rows(m, n);
  std::vector<Triplet> entries;
  for (int k = 0; k < m; ++k)
    for (SparseMatrix::InnerIterator entry(after.system.local, changed[k]); entry; ++entry)
      entries.emplace_back(k, static_cast<int>(entry.col()), scaled.row_scale[changed[k]] * entry.value());
  rows.setFromTriplets(entries.begin(), entries.end());
  Eigen::MatrixXd response = Eigen::MatrixXd::Zero(n, m);
  for (int k = 0; k < m; ++k) response(changed[k], k) = 1 / scaled.row_scale[changed[k]];
  response = old.solve(response);
  const Eigen::PartialPivLU<Eigen::MatrixXd> dense(rows * response);
  Eigen::MatrixXd x = old.solve(after.columns);
  const Eigen::MatrixXd wanted = scaled.row_scale.asDiagonal() * after.columns;
  x += response * dense.solve(wanted(changed, Eigen::all) - rows * x);
  const Eigen::MatrixXd residual = wanted - scaled.row_scale.asDiagonal() * (after.system.local * x);
  return (residual.colwise().norm().array() / wanted.colwise().norm().array()).maxCoeff();
}

/// Solves a part of a system alone; the rest is zero.
class ChangedPart {
 public:
  ChangedPart(const Bulk& bulk, const std::vector<int>& unknowns) : unknowns_(unknowns) {
    std::vector<int> place(bulk.size(), none);
    for (std::size_t k = 0; k < unknowns.size(); ++k) place[unknowns[k]] = static_cast<int>(k);
    std::vector<Triplet> entries;
    for (std::size_t k = 0; k < unknowns.size(); ++k)
      for (SparseMatrix::InnerIterator entry(bulk.system.local, unknowns[k]); entry; ++entry)
        if (place[entry.col()] != none) entries.emplace_back(static_cast<int>(k), place[entry.col()], entry.value());
    LinearSystem system;
    system.local.resize(unknowns.size(), unknowns.size());
    system.local.setFromTriplets(entries.begin(), entries.end());
    system.rows.resize(unknowns.size());
    std::iota(system.rows.begin(), system.rows.end(), 0);
    UnknownBlock block;
    block.name = "part";
    block.entities = static_cast<int>(unknowns.size());
    system.blocks = {block};
    if (!solver_.factor(system).solved) throw std::runtime_error("what has changed is singular by itself");
  }
  Vector solve(const Vector& b) const {
    Vector mine = b(unknowns_), result = Vector::Zero(b.size());
    solver_.solve_unchecked(mine);
    result(unknowns_) = mine;
    return result;
  }

 private:
  const std::vector<int>& unknowns_;
  UmfpackSolver solver_;
};

/// Right-preconditioned, without restart: first the changed part, then the old factorization for what is left. Returns
/// the number of iterations until the relative residual in the scaling is `tolerance`, 200 at most.
template <class Precondition>
int gmres(const SparseMatrix& a, const Vector& b, double tolerance, const Precondition& precondition, Vector& x) {
  constexpr int most = 200;
  Eigen::MatrixXd basis(b.size(), most + 1), searched(b.size(), most);
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(most + 1, most);
  const double norm = b.norm();
  basis.col(0) = b / norm;
  Vector g = Vector::Zero(most + 1), c(most), s(most);
  g[0] = norm;
  int k = 0;
  while (k < most && std::abs(g[k]) > tolerance * norm) {
    searched.col(k) = precondition(basis.col(k));
    Vector w = a * searched.col(k);
    for (int twice = 0; twice < 2; ++twice)
      for (int i = 0; i <= k; ++i) {
        const double along = basis.col(i).dot(w);
        h(i, k) += along;
        w -= along * basis.col(i);
      }
    h(k + 1, k) = w.norm();
    basis.col(k + 1) = w / h(k + 1, k);
    for (int i = 0; i < k; ++i) {
      const double upper = h(i, k);
      h(i, k) = c[i] * upper + s[i] * h(i + 1, k);
      h(i + 1, k) = -s[i] * upper + c[i] * h(i + 1, k);
    }
    const double length = std::hypot(h(k, k), h(k + 1, k));
    c[k] = h(k, k) / length;
    s[k] = h(k + 1, k) / length;
    h(k, k) = length;
    g[k + 1] = -s[k] * g[k];
    g[k] *= c[k];
    ++k;
  }
  x = searched.leftCols(k) * Vector(h.topLeftCorner(k, k).template triangularView<Eigen::Upper>().solve(g.head(k)));
  return k;
}

}  // namespace sprekk::growth_event
