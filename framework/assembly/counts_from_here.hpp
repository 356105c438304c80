// Parts whose unknowns are changes from a state at the start.
#pragma once

namespace sprekk {

/// A part with unknowns that are counted from a reference state.
class CountsFromHere {
 public:
  virtual ~CountsFromHere() = default;
  /// Throws InputError, with the reason, where it cannot be done.
  virtual void require_countable() const {}
  /// Makes the present state the reference: the unknowns become zero, and nothing else of the state changes. To be
  /// called after the state has been settled, with parts that have begun a step.
  virtual void count_from_here() = 0;
  /// Whether it counts from a state that was settled, of which it keeps more than fields: not on another mesh.
  virtual bool has_settled_reference() const { return false; }
};

}  // namespace sprekk
