// The parameters of the state that a run begins with.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/config/spec.hpp"

namespace sprekk {

/// Parameters of a scene's `start:`.
struct StartOptions {
  Origin origin;
  std::optional<std::string> from;  ///< a folder of results, or a checkpoint in it; relative to the working directory
  std::vector<std::string> settle;  ///< names of the components that are brought to equilibrium
  Spec spec();
};

}  // namespace sprekk
