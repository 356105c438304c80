// Assembles a whole system; parts whose terms are made anew from the state before.
#pragma once

#include <vector>

#include "framework/assembly/part.hpp"

namespace sprekk {

/// A part that makes its terms from the state: of a discretization whose coefficients follow unknowns.
class FollowsState {
 public:
  virtual ~FollowsState() = default;
  /// Called before any part adds its terms to an assembly. A part whose rows are not in it keeps what it has: others
  /// then see the terms with which its equations have been solved. Throws StateError where the state gives no terms.
  virtual void follow_state(const Assembly& assembly) = 0;
};

/// Lets all parts take the state that an assembly will have.
inline void follow_state(const std::vector<Part*>& parts, const Assembly& assembly) {
  for (FollowsState* part : parts_with<FollowsState>(parts)) part->follow_state(assembly);
}

/// Adds the terms of all parts, and then their fixed values: these replace rows that are complete.
inline void assemble_all(Assembly& assembly, const std::vector<Part*>& parts, const StepTime& step) {
  follow_state(parts, assembly);
  for (const Part* part : parts) part->assemble(assembly, step);
  for (const Part* part : parts) part->constrain(assembly);
}

}  // namespace sprekk
