// A copy of UMFPACK's factors, for solves with many right-hand sides at once.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "framework/types.hpp"

namespace sprekk {

/// The LU factors of a matrix, and solves for several columns together. UMFPACK itself solves for one vector at a time
/// and reads all factors for each. Here rows of a factor that meet only zeros are skipped, too: columns with few
/// non-zeros, as those of a fracture, cost a fraction of a back-solve each.
class UmfpackFactors {
 public:
  /// `numeric` is UMFPACK's object for the transpose of an n × n matrix A, unscaled.
  UmfpackFactors(void* numeric, int n);
  /// A X = B in place; B is given by its columns.
  void solve(Eigen::Ref<Eigen::MatrixXd> columns) const;
  double entries() const { return static_cast<double>(lower_values_.size() + upper_values_.size()); }

 private:
  int n_;
  std::vector<int> lower_start_, lower_column_, upper_start_, upper_row_, row_order_, column_order_;
  std::vector<double> lower_values_, upper_values_, inverse_diagonal_;
};

}  // namespace sprekk
