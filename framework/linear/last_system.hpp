// Remembers the last system that a solver was given, to see what of it changed.
#pragma once

#include <vector>

#include "framework/linear/linear_solver.hpp"

namespace sprekk {

/// How much of a system is new.
enum class Change { nothing, values, pattern };

/// Compares numbers or bits, so that what is reused gives the same bits as what would be computed anew. Collective:
/// every process gets the largest change of all.
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
