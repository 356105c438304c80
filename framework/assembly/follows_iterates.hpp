// What a part is that learns from the states that Newton's method tries.
#pragma once

#include <vector>

#include "framework/field/field.hpp"

namespace sprekk {

/// "My derivatives depend on the states that were looked at before."
class FollowsIterates {
 public:
  virtual ~FollowsIterates() = default;
  /// Called before a solve assembles the next state that it looks at, with its unknowns. All that depends on the order
  /// of states is changed here, so that Part::assemble gives one state the same terms however often it is called.
  virtual void follow_iterate(const std::vector<Field*>& unknowns) = 0;
};

}  // namespace sprekk
