// Parameters of the fluid, as flows in rock and in fractures declare them.
#pragma once

#include <string>

#include "components/capabilities/one_place.hpp"
#include "components/capabilities/usual_ranges.hpp"
#include "framework/config/spec.hpp"

namespace sprekk {

/// `source`: of the equation in which it stands.
inline void declare_viscosity(Spec& spec, Data& viscosity, const std::string& source) {
  spec.data("viscosity", viscosity,
            {.unit = "Pa*s",
             .range = positive(),
             .doc = "Viscosity of the fluid.",
             .source = source,
             .required = true,
             .material = true,
             .in_time = true});
  usually(spec, "viscosity", usual_viscosity());
}

/// `Compressibility`: Data, or std::optional of it where it is not required. `source`: where it is defined.
template <class Compressibility>
void declare_compressibility(Spec& spec, Compressibility& compressibility, const std::string& source, bool required) {
  spec.data("fluid_compressibility", compressibility,
            {.unit = "1/Pa",
             .range = between(0, 100),
             .doc = "Compressibility of the fluid; at most that of a gas at 0.01 Pa.",
             .source = source,
             .required = required,
             .material = true,
             .in_time = true});
  usually(spec, "fluid_compressibility", usual_compressibility());
}

inline void declare_gravity(Spec& spec, VectorData& gravity) {
  spec.vector("gravity", gravity,
              {.unit = "m/s^2",
               .doc = "Acceleration of gravity.",
               .material = true,
               .fixed = "what is at rest under gravity is found once"});
}

/// The weight of fluid between two places has to be one, whichever way leads from one to the other.
inline void check_gravity(const VectorData& gravity, const Node& node) {
  const Node* given = node.find("gravity");
  for (const Data& component : gravity.component)
    require_one_place(component, "'gravity'", "the weight of fluid follows from one acceleration",
                      given ? given->origin : node.origin);
}

}  // namespace sprekk
