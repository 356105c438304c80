// What a part is that helps preconditioners to solve block by block.
#pragma once

#include "framework/assembly/part.hpp"

namespace sprekk {

/// "I know what a block of unknowns feels of those that it is solved apart from."
class StabilizesPreconditioner {
 public:
  virtual ~StabilizesPreconditioner() = default;
  /// Adds diagonals that bring the blocks of fields near to their Schur complements. They change no answer.
  virtual void stabilize_preconditioner(Stabilization& stabilization) const = 0;
};

}  // namespace sprekk
