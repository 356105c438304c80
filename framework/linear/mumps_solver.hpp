// MUMPS behind the linear solver interface: one process or several.
#pragma once

#include <memory>

#include "framework/linear/equilibration.hpp"
#include "framework/linear/last_system.hpp"
#include "framework/linear/linear_solver.hpp"

namespace sprekk {

/// Multifrontal LU of rows that are distributed over the processes; starts MPI. Every process must call it.
class MumpsSolver final : public LinearSolver {
 public:
  MumpsSolver();
  ~MumpsSolver() override;
  MumpsSolver(const MumpsSolver&) = delete;
  MumpsSolver& operator=(const MumpsSolver&) = delete;

  LinearReport factor(const LinearSystem& system) override;
  LinearReport solve(const Vector& b_rows, Vector& x) override;
  bool solve_columns(Eigen::Ref<Eigen::MatrixXd> columns) override;
  std::string name() const override { return "mumps"; }

 private:
  struct Instance;  ///< MUMPS's own data
  LinearReport order();
  LinearReport factor_values();
  void apply_inverse(Vector& v, bool transposed);

  std::unique_ptr<Instance> mumps_;
  LastSystem last_;
  LinearReport last_report_;
  LinearSystem system_;  ///< rows and blocks; the matrix lives, scaled, in scaled_
  Equilibrated scaled_;
};

}  // namespace sprekk
