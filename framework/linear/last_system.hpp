// Finds out what has changed since the last system that a solver was given.
#pragma once

#include <optional>
#include <vector>

#include "framework/linear/linear_solver.hpp"

namespace sprekk {

/// What has changed since the last system: nothing, the values, or the sparsity pattern (and so the values).
enum class Change { nothing, values, pattern };

/// A number for LinearSystem::number from a caller that has compared the system with earlier ones: if two systems have
/// the same pattern number, not 0, and different numbers of this kind, their values differ. So solvers need no copy of
/// a system to compare the next one with.
std::uint64_t new_telling_number();

/// Whether two systems have entries at the same places on this process; and whether these have the same bits.
bool have_same_places(const LinearSystem& a, const LinearSystem& b);
bool have_same_bits(const LinearSystem& a, const LinearSystem& b);

/// Remembers the last system, and compares the next one with it by number or bit by bit, so that a factorization that
/// is reused has the same bits as one that is computed anew. A system with a number of new_telling_number is not
/// copied. Collective: every process gets the largest change of all.
class LastSystem {
 public:
  Change compare_and_remember(const LinearSystem& system);
  void forget() { remembered_ = false; }

 private:
  struct Copy {
    std::vector<int> rows, outer, inner;
    std::vector<double> values;
    std::vector<Vector> stabilizations;
    bool has_pattern_of(const LinearSystem& system) const;
    bool has_values_of(const LinearSystem& system) const;
  };
  bool remembered_ = false;
  std::uint64_t pattern_number_ = 0, number_ = 0;
  std::optional<Copy> copy_;  ///< none where numbers tell
};

}  // namespace sprekk
