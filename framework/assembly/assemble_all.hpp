// Assembles a whole system.
#pragma once

#include <vector>

#include "framework/assembly/part.hpp"

namespace sprekk {

/// Adds the terms of all parts, and then their fixed values: these replace rows that are complete.
inline void assemble_all(Assembly& assembly, const std::vector<Part*>& parts, const StepTime& step) {
  for (const Part* part : parts) part->assemble(assembly, step);
  for (const Part* part : parts) part->constrain(assembly);
}

}  // namespace sprekk
