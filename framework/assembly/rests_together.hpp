// The interface of a part that joins components which come to rest together only.
#pragma once

#include <vector>

#include "framework/assembly/part.hpp"

namespace sprekk {

/// A part whose components reach a state at rest only together. If one of them were settled alone, terms of the part
/// would keep their values from before, and the state would change from the first step on.
class RestsTogether {
 public:
  virtual ~RestsTogether() = default;
  /// Pairs of components of which the first has no state at rest without the second (Dependence::component, on).
  virtual std::vector<Dependence> dependences_at_rest() const = 0;
};

}  // namespace sprekk
