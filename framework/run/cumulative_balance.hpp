// Checks that a run conserves all quantities with a balance.
#pragma once

#include <map>
#include <string>

#include "framework/assembly/part.hpp"

namespace sprekk {

/// Compares the error of each balance with the largest throughput of that balance so far.
class CumulativeBalance {
 public:
  /// `balances`: at the end of the step that is about to be accepted. `tolerance`: the part of what is moved to which
  /// the schedule keeps the balances in each step. Where it is small only round-off can be missing; where nothing
  /// moves, round-off is all that there is.
  void note_step(const std::map<std::string, Balance>& balances, double tolerance, Notes& notes);

  /// State for checkpoints.
  void save(std::map<std::string, Vector>& state) const;
  void restore(const std::map<std::string, Vector>& state);

 private:
  std::map<std::string, double> throughput_;
};

}  // namespace sprekk
