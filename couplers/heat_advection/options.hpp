// What a scene gives to heat_advection.
#pragma once

#include <map>
#include <string>

#include "framework/config/data.hpp"
#include "framework/config/spec.hpp"

namespace sprekk::couplers {

/// Fluid that is injected at a place of the scene.
struct Injected {
  Origin origin;
  Data temperature;  ///< K
};

/// The parameters of heat_advection.
struct HeatAdvectionOptions {
  double fluid_heat_capacity = 0;            ///< J/(m^3 K)
  std::map<std::string, Injected> injected;  ///< by the name of the place in the flow
  Spec spec();
};

}  // namespace sprekk::couplers
