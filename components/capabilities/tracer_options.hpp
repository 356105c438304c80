// What a dissolved tracer is, in rock and fractures alike.
#pragma once

#include <string>

#include "framework/config/spec.hpp"

namespace sprekk {

/// Declares `retardation`, with this sentence, `decay` (1/s) and `initial_concentration` (kg/m^3).
inline void declare_tracer(Spec& spec, Data& retardation, const std::string& sorbed, Data& decay, Data& initial) {
  spec.data("retardation", retardation,
            {.unit = "",
             .range = {.low = 1},
             .doc = sorbed,
             .fixed = "the tracer is counted by changes of the concentration"});
  spec.data("decay", decay,
            {.unit = "1/s",
             .range = non_negative(),
             .doc = "Rate of decay, ln(2) over the half-life, of what is dissolved and sorbed.",
             .fixed = "it is that of a substance"});
  spec.data("initial_concentration", initial,
            {.unit = "kg/m^3",
             .range = non_negative(),
             .doc = "Concentration at the start, per volume of fluid.",
             .fixed = "it is what the run starts from"});
}

}  // namespace sprekk
