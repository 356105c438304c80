// MUMPS behind the linear solver interface: one process or several.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>

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
  std::optional<LinearReport> factor_bordered(const LinearSystem& system, const SparseMatrix& columns,
                                              const SparseMatrix& rows, Eigen::MatrixXd& schur) override;
  std::string name() const override { return "mumps"; }

 private:
  struct Instance;   ///< MUMPS's own data
  struct Orderings;  ///< instances whose solvers are no more
  static Orderings& orderings();
  friend class KeptOrderings;
  /// Columns and rows around the matrix that are not eliminated, scaled.
  struct Border {
    SparseMatrix columns, rows;
    Vector column_scale, row_scale;  ///< the factors, powers of two, by which columns and rows have been multiplied
    int size() const { return static_cast<int>(std::max(columns.cols(), rows.rows())); }
  };
  Border scaled(const SparseMatrix& columns, const SparseMatrix& rows);
  Change take(const LinearSystem& system);
  LinearReport factor_scaled(bool has_new_pattern);
  LinearReport order();
  void list_entries();
  double* list_values();
  LinearReport factor_values();
  LinearReport not_singular();
  void back_substitute(Eigen::MatrixXd& columns);
  Eigen::MatrixXd solution_at_pivots(Eigen::MatrixXd& columns);
  void make_whole_inverse(Vector& v);

  std::unique_ptr<Instance> mumps_;
  LastSystem last_;
  LinearReport last_report_;
  LinearSystem system_;  ///< rows and blocks; the matrix lives, scaled, in scaled_
  Equilibrated scaled_;
  Border border_;
};

}  // namespace sprekk
