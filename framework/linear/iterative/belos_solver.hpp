// GMRES with the block preconditioner: for systems too large for a direct solver, on one process or several.
#pragma once

#include <memory>
#include <vector>

#include "framework/linear/last_system.hpp"
#include "framework/linear/linear_solver.hpp"

namespace sprekk {

/// Right-preconditioned GMRES (Belos) on the equilibrated system; starts MPI. Every process must call it. The
/// preconditioner works in the original units, where the near-null spaces are the rigid-body modes and the constants.
/// The solve has converged when the true residual is below `tolerance` times the right-hand side (or at round-off), and
/// in every block below `tolerance` times the size of the terms, |A| |x| + |b|.
class BelosSolver final : public LinearSolver {
 public:
  BelosSolver(double tolerance, int max_iterations);
  ~BelosSolver() override;

  LinearReport factor(const LinearSystem& system) override;
  LinearReport solve(const Vector& b_rows, Vector& x) override;
  std::string name() const override { return "belos"; }

 private:
  struct Data;
  struct BlockResidual {
    double largest_ratio = 0;      ///< ||r|| / || |A| |y| + |b| || of the worst block
    double smallest_size = 1e300;  ///< the smallest of the blocks' || |A| |y| + |b| ||
    std::vector<double> ratios;    ///< of each block
  };
  BlockResidual measure(const Vector& whole_y, const Vector& b, const Vector& r) const;
  int block_of(int row) const;  ///< of an own row
  /// The residual of blocks whose ratio exceeds `converged`.
  Vector left_to_solve(const Vector& r, const BlockResidual& measured, double converged) const;

  double tolerance_;
  int max_iterations_;
  LastSystem last_;
  LinearReport last_report_;
  std::unique_ptr<Data> data_;
};

}  // namespace sprekk
