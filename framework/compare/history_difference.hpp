// How far histories of two runs are apart.
#pragma once

#include <string>
#include <vector>

#include "framework/results/csv_table.hpp"

namespace sprekk {

/// The difference of one column of two histories.
struct HistoryDifference {
  std::string column;  ///< "quantity[unit]"
  double largest = 0;  ///< absolute value, SI; infinite where one run has a value and the other has none
  double time = 0;     ///< s, where it is largest
  double scale = 0;    ///< SI: the range of both runs together, see `history_differences`
};

/// The time that both histories have, s; empty where `first` > `last`.
struct CommonTime {
  double first, last;
};
CommonTime common_time(const CsvTable& one, const CsvTable& other);

/// The differences of all columns of numbers that both histories have, over the time that both have. Between rows a
/// history is linear, so that the difference is largest at a row of one of them. Components of a vector ("slip.n" and
/// "slip.t") share the larger scale, and so do the amounts of a balance and its error.
std::vector<HistoryDifference> history_differences(const CsvTable& one, const CsvTable& other);

}  // namespace sprekk
