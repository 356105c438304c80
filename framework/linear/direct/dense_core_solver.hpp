// LU of a matrix most of whose rows have a few entries, and the others many: what is left on fractures of a bulk that
// was eliminated.
#pragma once

#include <utility>
#include <vector>

#include "framework/linear/direct/umfpack_solver.hpp"

namespace sprekk {

/// Eliminates with the short rows first, one row after the other, and factorizes the core that is left as a dense
/// matrix (LAPACK). Entries that are zero count as absent, so where friction holds walls, their jumps are no unknowns
/// of the core, and it has the size of what slips. Systems that leave a large core for another reason than long rows
/// go to UMFPACK. All choices follow from the values of the matrix alone. One process.
class DenseCoreSolver final : public LinearSolver {
 public:
  LinearReport factor(const LinearSystem& system) override;
  LinearReport solve(const Vector& b_rows, Vector& x) override;
  std::string name() const override { return is_sparse_ ? umfpack_.name() : "dense core"; }
  const LinearCounts& counts() const override;

  int core_size() const { return static_cast<int>(core_.rows()); }  ///< of the last system

 private:
  using Terms = std::vector<std::pair<int, double>>;
  /// A row of the matrix after elimination of earlier pivots: `lower` are these with their factors, `upper` columns
  /// without a pivot.
  struct Row {
    int row = -1, column = -1;  ///< `column`: of the pivot
    double pivot = 0;
    Terms lower, upper;
  };
  Row reduced(int row);
  bool choose_pivot(Row& row) const;
  void eliminate_short_rows();
  bool gather_core();
  void take_single_columns(std::vector<Row>& rows);
  LinearReport factor_core();
  void apply_inverse(Vector& v) const;
  LinearReport solve_with_free_pivots(const Vector& b_rows, Vector& x);

  LinearSystem system_;  ///< rows and blocks; the matrix lives, scaled, in scaled_
  Equilibrated scaled_;
  LinearReport last_report_;
  std::vector<int> entries_;   ///< of every column, without zeros
  std::vector<int> pivot_of_;  ///< of every column: the number of its pivot, or -1
  std::vector<Row> pivots_;    ///< rows with a pivot, in the order of elimination
  std::vector<Row> last_;      ///< rows of the core with the only entry of a column; solved after the core
  std::vector<Row> rows_of_core_;
  std::vector<int> columns_of_core_;
  Eigen::MatrixXd core_;          ///< its LU factors
  std::vector<int> exchanged_;    ///< rows that its factorization has exchanged (dgetrf)
  std::vector<double> work_;      ///< a value for each column
  std::vector<char> is_touched_;  ///< columns of the row in work_
  bool is_sparse_ = false;        ///< whether the last system went to UMFPACK
  UmfpackSolver umfpack_;
  mutable LinearCounts total_;
};

}  // namespace sprekk
