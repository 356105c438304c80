// The interface of a part that stabilizes block preconditioners.
#pragma once

#include "framework/assembly/part.hpp"

namespace sprekk {

/// A part that approximates the Schur complements of its blocks by diagonals.
class StabilizesPreconditioner {
 public:
  virtual ~StabilizesPreconditioner() = default;
  /// Adds diagonals that bring the blocks of fields near to their Schur complements. They change no answer.
  virtual void stabilize_preconditioner(Stabilization& stabilization) const = 0;
};

}  // namespace sprekk
