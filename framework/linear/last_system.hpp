// Finds out what has changed since the last system that a solver was given.
#pragma once

#include <vector>

#include "framework/linear/linear_solver.hpp"

namespace sprekk {

/// How much of a system is new: nothing, its values, or its sparsity pattern (and so its values).
enum class Change { nothing, values, pattern };

/// Remembers the last system, and compares the next one with it by number or bit by bit, so that a factorization that
/// is reused has the same bits as one that is computed anew. Collective: every process gets the largest change of all.
class LastSystem {
 public:
  Change compare_and_remember(const LinearSystem& system);
  void forget() { remembered_ = false; }

 private:
  bool remembered_ = false;
  std::uint64_t pattern_number_ = 0, number_ = 0;
  std::vector<int> rows_, outer_, inner_;
  std::vector<double> values_;
  std::vector<Vector> stabilizations_;
};

}  // namespace sprekk
