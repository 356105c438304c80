// The interface of a part whose equations no iterative solver can take.
#pragma once

#include <string>

#include "framework/field/field.hpp"

namespace sprekk {

/// A part that says why systems with one of its fields need a direct solver.
class NeedsDirectSolver {
 public:
  /// What cannot be solved iteratively.
  struct Need {
    const Field* field = nullptr;  ///< systems with this unknown need it; nullptr where none does
    std::string because;
  };
  virtual ~NeedsDirectSolver() = default;
  virtual Need needs_direct_solver() const = 0;
};

}  // namespace sprekk
