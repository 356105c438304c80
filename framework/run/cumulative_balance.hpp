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
  /// the schedule keeps them in each step; where it is small, no more than round-off can be missing, and that is all
  /// there is where nothing moves.
  void note_step(const std::map<std::string, Balance>& balances, double tolerance, Notes& notes);

  /// State for checkpoints.
  void save(std::map<std::string, Vector>& state) const;
  void restore(const std::map<std::string, Vector>& state);

 private:
  std::map<std::string, double> throughput_;
};

}  // namespace sprekk
