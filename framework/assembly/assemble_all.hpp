// Assembles all terms of all parts, and then their prescribed values.
#pragma once

#include <vector>

#include "framework/assembly/part.hpp"

namespace sprekk {

inline void assemble_all(Assembly& assembly, const std::vector<Part*>& parts, const StepTime& step) {
  for (const Part* part : parts) part->assemble(assembly, step);
  for (const Part* part : parts) part->constrain(assembly);
}

}  // namespace sprekk
