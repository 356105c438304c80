// Names unknowns for messages.
#pragma once

#include <string>
#include <vector>

#include "framework/linear/linear_solver.hpp"

namespace sprekk {

/// "rock.displacement, entity 12, component 1", or "unknown 7" if no block holds it.
std::string describe_unknown(const std::vector<UnknownBlock>& blocks, int unknown);

}  // namespace sprekk
