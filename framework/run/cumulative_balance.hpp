// Checks that a run conserves all quantities with a balance.
#pragma once

#include <map>
#include <string>

#include "framework/assembly/part.hpp"

namespace sprekk {

/// Compares the error of each balance with the largest throughput of that balance so far.
class CumulativeBalance {
 public:
  /// `balances`: at the end of the step that is about to be accepted. `tolerance`: the error of a balance over its
  /// throughput that the schedule allows in a step. Where it is at most 1e-6, only round-off can be missing, and there
  /// is no note.
  void note_step(const std::map<std::string, Balance>& balances, double tolerance, Notes& notes);

  /// State for checkpoints.
  void save(std::map<std::string, Vector>& state) const;
  void restore(const std::map<std::string, Vector>& state);

 private:
  std::map<std::string, double> throughput_;
};

}  // namespace sprekk
