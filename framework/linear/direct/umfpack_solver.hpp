// UMFPACK behind the linear solver interface: one process.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "framework/linear/equilibration.hpp"
#include "framework/linear/last_system.hpp"
#include "framework/linear/linear_solver.hpp"

namespace sprekk {

/// Sparse LU with METIS ordering. Equal systems give equal bits, whatever was solved before: the ordering depends on
/// the sparsity pattern only.
class UmfpackSolver final : public LinearSolver {
 public:
  UmfpackSolver();
  ~UmfpackSolver() override;
  UmfpackSolver(const UmfpackSolver&) = delete;
  UmfpackSolver& operator=(const UmfpackSolver&) = delete;

  LinearReport factor(const LinearSystem& system) override;
  LinearReport solve(const Vector& b_rows, Vector& x) override;
  /// Solves A x = b in place for one column, without a check of the residual.
  void solve_unchecked(Eigen::Ref<Vector> b) const;
  bool solve_columns(Eigen::Ref<Eigen::MatrixXd> columns) override;
  std::string name() const override { return "umfpack"; }
  long factor_entries() const { return factor_entries_; }  ///< of both factors, of the last factorization

 private:
  LinearReport order();
  /// The unknowns in an order that is found for entities (EntityGraph); empty where it has to be found for unknowns.
  std::vector<int> order_of_entities() const;
  LinearReport factor_values();
  void apply_inverse(Vector& v) const;
  std::string describe_zero_pivot() const;

  std::array<double, 20> control_;
  LastSystem last_;
  LinearReport last_report_;
  LinearSystem system_;  ///< rows and blocks; the matrix lives, scaled, in scaled_
  Equilibrated scaled_;
  void* symbolic_ = nullptr;
  void* numeric_ = nullptr;
  long factor_entries_ = 0;
  mutable std::vector<int> integer_work_;
  mutable std::vector<double> work_;
  mutable Vector right_hand_side_;
};

}  // namespace sprekk
