// The programs that take part in a run.
#pragma once

#include <vector>

#include "framework/assembly/part.hpp"
#include "framework/scene/start_options.hpp"

namespace sprekk {

/// Throws InputError if the user has not named a program that a part needs, or has named one for a component that needs
/// none.
void require_programs(const std::vector<Part*>& parts);

/// Throws InputError for scenes in which a program cannot take part.
void require_programs_can_join(const std::vector<Part*>& parts, bool has_growth, const StartOptions& start);

}  // namespace sprekk
