// The interface of a part whose unknowns are changes from a state at the start.
#pragma once

namespace sprekk {

/// A part with unknowns that are counted from a reference state.
class CountsFromHere {
 public:
  virtual ~CountsFromHere() = default;
  /// Throws InputError, with the reason, where the part cannot do this.
  virtual void require_countable() const {}
  /// Makes the present state the reference: the unknowns become zero, and nothing else of the state changes. To be
  /// called after the state has been settled, with parts that have begun a step.
  virtual void count_from_here() = 0;
  /// Whether the reference state was settled and consists of more than fields. Such a part cannot be carried over to
  /// another mesh.
  virtual bool has_settled_reference() const { return false; }
};

}  // namespace sprekk
