// Parts whose derivatives depend on the iterates of Newton's method.
#pragma once

#include <vector>

#include "framework/field/field.hpp"

namespace sprekk {

/// A part with derivatives that depend on the iterates before the present one.
class IterateDependent {
 public:
  virtual ~IterateDependent() = default;
  /// Called before a solve assembles its next iterate; `unknowns`: those of the solve. All that depends on the order of
  /// iterates is changed here, so that Part::assemble gives an iterate the same terms however often it is called.
  virtual void observe_iterate(const std::vector<Field*>& unknowns) = 0;
};

}  // namespace sprekk
