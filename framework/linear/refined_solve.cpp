#include "framework/linear/refined_solve.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "framework/invariants.hpp"
#include "framework/linear/unknown_names.hpp"
#include "framework/parallel/gathered.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

double norm(const Vector& rows) { return std::sqrt(parallel::sum(rows.squaredNorm())); }

}  // namespace

Vector whole_vector(const std::vector<int>& rows, const Vector& mine, int unknowns) {
  SPREKK_EXPECT(static_cast<Eigen::Index>(rows.size()) == mine.size(), rows.size(), mine.size());
  SPREKK_EXPECT(are_indices(rows, unknowns), unknowns);
  if (parallel::size() == 1) return mine;
  return parallel::WholeVectors(rows, unknowns).whole(mine);
}

double componentwise_backward_error(const SparseMatrix& a, const Vector& y, const Vector& b, const Vector& r) {
  SPREKK_EXPECT(y.size() == a.cols(), y.size(), a.cols());
  SPREKK_EXPECT(b.size() == a.rows() && r.size() == a.rows(), b.size(), r.size(), a.rows());
  const int* outer = a.outerIndexPtr();
  double largest = 0;
  for (int row = 0; row < a.rows(); ++row) {
    if (r[row] == 0) continue;
    double size = std::abs(b[row]);
    for (int k = outer[row]; k < outer[row + 1]; ++k) size += std::abs(a.valuePtr()[k] * y[a.innerIndexPtr()[k]]);
    largest = std::max(largest, std::abs(r[row]) / size);
  }
  return parallel::max(largest);
}

LinearReport refined_solve(const LinearSystem& system, const Equilibrated& scaled, const Vector& b_rows,
                           const std::function<void(Vector&)>& apply_inverse, Vector& x) {
  constexpr int refinements = 3;  // steps, at most
  // Six digits above round-off; no solution at all.
  constexpr double acceptable = 1e-10, useless = 0.3;
  SPREKK_EXPECT(b_rows.size() == scaled.matrix.rows(), b_rows.size(), scaled.matrix.rows());
  SPREKK_EXPECT(scaled.row_scale.size() == b_rows.size(), scaled.row_scale.size(), b_rows.size());
  SPREKK_EXPECT(scaled.column_scale.size() == scaled.matrix.cols(), scaled.column_scale.size(), scaled.matrix.cols());
  SPREKK_EXPECT(scaled.mistake.empty(), scaled.mistake);
  const SparseMatrix& a = scaled.matrix;
  const int unknowns = static_cast<int>(a.cols());
  const Vector b = scaled.row_scale.cwiseProduct(b_rows);
  const double b_norm = norm(b);
  const double a_norm = scaled.norm / std::sqrt(unknowns);
  if (!std::isfinite(b_norm))
    return LinearReport::failure("the right-hand side has an entry that is not a finite number");

  x = Vector::Zero(unknowns);
  LinearReport report = LinearReport::success();
  if (b_norm == 0) return report;

  const auto whole_solution = [&](Vector rows) {
    apply_inverse(rows);
    SPREKK_ASSERT(rows.size() == unknowns, rows.size(), unknowns);
    return rows;
  };
  Vector y = whole_solution(b);
  Vector r = b - a * y;
  double error = componentwise_backward_error(a, y, b, r);
  for (int step = 0; step < refinements && error > rounding::of_terms; ++step) {
    const Vector candidate = whole_solution(r) + y;
    Vector r_candidate = b - a * candidate;
    const double candidate_error = componentwise_backward_error(a, candidate, b, r_candidate);
    if (!(candidate_error < error)) break;
    const bool stalls = candidate_error > 0.5 * error;
    y = candidate;
    r = std::move(r_candidate);
    error = candidate_error;
    if (stalls) break;
  }
  x = scaled.column_scale.cwiseProduct(y);
  const double r_norm = norm(r);
  const double normwise_error = r_norm / (a_norm * y.norm() + b_norm);
  report.relative_residual = r_norm / b_norm;
  if (!(normwise_error <= acceptable) || !(report.relative_residual <= useless)) {
    int largest = 0;  // a null vector of the matrix dominates such a solution
    y.cwiseAbs().maxCoeff(&largest);
    char text[200];
    std::snprintf(text, sizeof text,
                  "the matrix is singular to working precision (backward error %.1e, relative residual %.1e; look at ",
                  normwise_error, report.relative_residual);
    report.reason = text + describe_unknown(system.blocks, largest) + " and its like)";
    report.solved = false;
  }
  return report;
}

}  // namespace sprekk
