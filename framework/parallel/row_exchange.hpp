// Numbered rows that change their process.
#pragma once

#include <vector>

#include "framework/types.hpp"

namespace sprekk::parallel {

/// Moves numbered rows of a matrix from the processes that have them to those that need them. No process holds more
/// than the rows that it has, those that it needs, and the numbers of its share of all rows.
class RowExchange {
 public:
  /// `have`, `want`: numbers from 0 on of this process's rows before and after, in any order, each once. A wanted row
  /// is had by exactly one process; several may want it. Collective.
  RowExchange(const std::vector<int>& have, const std::vector<int>& want);
  /// The wanted rows of a matrix of the rows that this process has. Collective: as many columns on every process.
  Eigen::MatrixXd moved(const Eigen::Ref<const Eigen::MatrixXd>& rows) const;

 private:
  std::vector<std::vector<int>> sent_, received_;  ///< for each process: places among the rows here
  int wanted_ = 0;
};

}  // namespace sprekk::parallel
