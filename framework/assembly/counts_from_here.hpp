// The interfaces of parts whose unknowns or amounts are changes from a state at the start.
#pragma once

#include <algorithm>
#include <vector>

namespace sprekk {

class Field;

/// The fields that were solved for when the state at the start was settled; all others were held. None where a run
/// begins with initial values.
struct SettledFields {
  std::vector<const Field*> fields;
  bool contain(const Field& field) const { return std::ranges::count(fields, &field) > 0; }
};

/// A part with unknowns, or loads, that are counted from a reference state.
class CountsFromHere {
 public:
  virtual ~CountsFromHere() = default;
  /// Throws InputError, with the reason, where the part cannot do this.
  virtual void require_countable() const {}
  /// Makes the present state the reference: unknowns that are changes become zero where they were settled, and settled
  /// fields exert no load. Nothing else of the state changes. To be called after the state has been settled, with parts
  /// that have begun a step, components before couplers.
  virtual void count_from_here(const SettledFields& settled) = 0;
  /// Whether the reference state was settled and consists of more than fields. Such a part cannot be carried over to
  /// another mesh.
  virtual bool has_settled_reference() const { return false; }
};

/// A part with amounts that are counted by changes of the state.
class CountsAmounts {
 public:
  virtual ~CountsAmounts() = default;
  /// From now on no amount contains a change that was made before this call. To be called after all references have
  /// been set (CountsFromHere).
  virtual void count_amounts_from_here(const SettledFields& settled) = 0;
};

}  // namespace sprekk
