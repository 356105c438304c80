// The factors of UMFPACK, taken out for solving with many right-hand sides at once.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "framework/types.hpp"

namespace sprekk {

/// The library solves for one vector at a time and so reads all factors for each. Here a few columns are worked on
/// together, and rows of a factor that only zeros would meet are skipped: columns that couple to few unknowns, as those
/// of a fracture do, cost a fraction of a back-solve each.
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
