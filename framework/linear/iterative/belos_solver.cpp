#include "framework/linear/iterative/belos_solver.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "framework/linear/equilibration.hpp"
#include "framework/linear/iterative/block_preconditioner.hpp"
#include "framework/linear/stopwatch.hpp"
#include "framework/linear/trilinos_module/trilinos_module.hpp"
#include "framework/parallel/gathered.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {

/// The preconditioner M of A as one of R A C: C^-1 M R^-1.
class ScaledPreconditioner {
 public:
  ScaledPreconditioner(const LinearSystem& system, const Vector& row_scale, const Vector& own_column_scale)
      : row_scale_(row_scale), column_scale_(own_column_scale), preconditioner_(system) {}

  void apply(const Vector& x, Vector& y) const {
    preconditioner_.apply(x.cwiseQuotient(row_scale_), y);
    y = y.cwiseQuotient(column_scale_).eval();
  }

 private:
  Vector row_scale_, column_scale_;
  BlockPreconditioner preconditioner_;
};

struct BelosSolver::Data {
  std::vector<int> rows;
  parallel::WholeVectors of_rows;  ///< from this process's rows to all unknowns
  int unknowns = 0;
  std::vector<int> block_ends;  ///< first unknown after every block, ascending
  Equilibrated scaled;
  std::unique_ptr<ScaledPreconditioner> preconditioner;
  std::unique_ptr<Gmres> gmres;  ///< for the matrix of `scaled`
};

BelosSolver::BelosSolver(double tolerance, int max_iterations)
    : tolerance_(tolerance), max_iterations_(max_iterations), data_(std::make_unique<Data>()) {
  trilinos();
  use_one_blas_thread();
}

BelosSolver::~BelosSolver() = default;

LinearReport BelosSolver::factor(const LinearSystem& system) {
  if (!system.local.isCompressed()) {
    LinearSystem compressed = system;
    compressed.local.makeCompressed();
    return factor(compressed);
  }
  if (last_.compare_and_remember(system) == Change::nothing) {
    ++counts_.reused;
    return last_report_;
  }
  const Stopwatch watch(counts_.seconds_factor);
  ++counts_.factorizations;
  *data_ = Data();
  try {
    data_->scaled = equilibrate(system);
    const Equilibrated& scaled = data_->scaled;
    if (!scaled.mistake.empty()) return last_report_ = LinearReport::failure(scaled.mistake);
    data_->rows = system.rows;
    data_->unknowns = static_cast<int>(system.local.cols());
    data_->of_rows = parallel::WholeVectors(system.rows, data_->unknowns);
    data_->block_ends = {data_->unknowns};
    for (const UnknownBlock& block : system.blocks)
      data_->block_ends.push_back(block.first + block.entities * block.components);
    std::sort(data_->block_ends.begin(), data_->block_ends.end());
    Vector own_column_scale(system.rows.size());
    for (std::size_t k = 0; k < system.rows.size(); ++k) own_column_scale[k] = scaled.column_scale[system.rows[k]];
    data_->preconditioner = std::make_unique<ScaledPreconditioner>(system, scaled.row_scale, own_column_scale);
    const auto precondition = [&preconditioner = *data_->preconditioner](const Vector& r, Vector& z) {
      preconditioner.apply(r, z);
    };
    constexpr int most_vectors = 100;  // that are kept until a restart: each costs a product with all before it
    data_->gmres = trilinos().gmres(scaled.matrix, system.rows, precondition, std::min(most_vectors, max_iterations_));
    last_report_ = LinearReport::success();
  } catch (const std::exception& error) {
    last_report_ = LinearReport::failure(std::string("the preconditioner could not be set up: ") + error.what());
  }
  return last_report_;
}

int BelosSolver::block_of(int row) const {
  const std::vector<int>& ends = data_->block_ends;
  return static_cast<int>(std::upper_bound(ends.begin(), ends.end(), data_->rows[row]) - ends.begin());
}

// In the residual of all, that of a block whose values are small beside those of others is lost in their round-off.
Vector BelosSolver::left_to_solve(const Vector& r, const BlockResidual& measured, double converged) const {
  Vector left = r;
  for (int row = 0; row < left.size(); ++row)
    if (measured.ratios[block_of(row)] <= converged) left[row] = 0;
  return left;
}

// ||r|| / || |A| |y| + |b| || of every block that has rows on any process, and the smallest of the denominators. With
// one norm over all unknowns GMRES would neglect a block whose values are small beside those of others.
BelosSolver::BlockResidual BelosSolver::measure(const Vector& whole_y, const Vector& b, const Vector& r) const {
  const SparseMatrix& a = data_->scaled.matrix;
  const int blocks = static_cast<int>(data_->block_ends.size());
  Vector sums = Vector::Zero(2 * blocks);
  for (int row = 0; row < a.rows(); ++row) {
    double size = std::abs(b[row]);
    for (SparseMatrix::InnerIterator entry(a, row); entry; ++entry)
      size += std::abs(entry.value() * whole_y[entry.col()]);
    const int block = block_of(row);
    sums[2 * block] += r[row] * r[row];
    sums[2 * block + 1] += size * size;
  }
  parallel::sum(sums);
  // Where nothing drives a block, its values are round-off of others, and its terms are as small as its residual.
  double size_of_all = 0;
  for (int block = 0; block < blocks; ++block) size_of_all += sums[2 * block + 1];
  const double negligible = tolerance_ * std::numeric_limits<double>::epsilon() * std::sqrt(size_of_all);
  BlockResidual result;
  for (int block = 0; block < blocks; ++block) {
    const double residual = std::sqrt(sums[2 * block]), size = std::sqrt(sums[2 * block + 1]);
    const bool is_zero = residual <= negligible;
    result.ratios.push_back(is_zero ? 0 : residual / size);
    if (is_zero) continue;
    result.largest_ratio = std::max(result.largest_ratio, residual / size);
    result.smallest_size = std::min(result.smallest_size, size);
  }
  return result;
}

LinearReport BelosSolver::solve(const Vector& b_rows, Vector& x) {
  if (!last_report_.solved) return last_report_;
  const Stopwatch watch(counts_.seconds_solve);
  ++counts_.solves;
  const Vector b = data_->scaled.row_scale.cwiseProduct(b_rows);
  const double b_norm = std::sqrt(parallel::sum(b.squaredNorm()));
  if (!std::isfinite(b_norm))
    return LinearReport::failure("the right-hand side has an entry that is not a finite number");
  x = Vector::Zero(data_->unknowns);
  LinearReport report = LinearReport::success();
  if (b_norm == 0) return report;

  Vector r = b, y = x;
  // The loop below restarts GMRES from the true residual.
  constexpr double safely = 0.5;  // of the tolerance, since GMRES tests another norm than the loop below
  double r_norm = b_norm, wanted_norm = safely * tolerance_ * b_norm;
  BlockResidual measured;
  double ratio_before = 0, left_norm = 0;
  // Backward error of a block that is round-off; residual of all with which it may be.
  constexpr double rounding = 1e-14, useless = 1e-3;
  const auto is_converged = [&] {
    const bool is_at_rounding = measured.largest_ratio <= rounding && r_norm <= useless * b_norm;
    return measured.largest_ratio <= tolerance_ && (r_norm <= tolerance_ * b_norm || is_at_rounding);
  };
  // GMRES tests a residual from a recurrence, in one norm. This loop tests the true residual of every block, and
  // restarts GMRES from it.
  for (int restart = 0; report.iterations < max_iterations_; ++restart) {
    constexpr double deepest = 1e-12, shallowest = 0.1;  // of one restart
    Gmres::Result step;
    const bool some_are_left = r_norm <= tolerance_ * b_norm;
    const Vector left = restart == 0 ? r : left_to_solve(r, measured, some_are_left ? tolerance_ : rounding);
    const double left_before = left_norm;
    left_norm = std::sqrt(parallel::sum(left.squaredNorm()));
    // A smaller gain than half ends the restarts, as usual for iterative refinement. For a block whose solution is zero
    // only the residual falls, and the ratio does not.
    const bool stalls =
        restart > 1 && !(measured.largest_ratio < 0.5 * ratio_before) && !(left_norm < 0.5 * left_before);
    if (left_norm == 0 || stalls) break;
    try {
      step = data_->gmres->solve(left, std::clamp(wanted_norm / left_norm, deepest, shallowest),
                                 max_iterations_ - report.iterations);
    } catch (const std::exception& error) {
      return LinearReport::failure(std::string("GMRES broke down: ") + error.what());
    }
    report.iterations += step.iterations;
    y += data_->of_rows.whole(step.x);
    r = b - data_->scaled.matrix * y;
    r_norm = std::sqrt(parallel::sum(r.squaredNorm()));
    ratio_before = measured.largest_ratio;
    measured = measure(y, b, r);
    if (is_converged()) break;
    wanted_norm = safely * tolerance_ * std::min(b_norm, measured.smallest_size);
  }
  counts_.iterations += report.iterations;
  report.relative_residual = r_norm / b_norm;
  x = data_->scaled.column_scale.cwiseProduct(y);
  if (!is_converged()) {
    char text[200];
    std::snprintf(
        text, sizeof text,
        "GMRES did not converge (relative residual %.1e, of the worst block %.1e, after %d iterations; wanted %.1e)",
        report.relative_residual, measured.largest_ratio, report.iterations, tolerance_);
    report.solved = false;
    report.reason = text;
  }
  return report;
}

}  // namespace sprekk
