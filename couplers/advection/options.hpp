// What a scene gives to heat_advection and tracer_advection.
#pragma once

#include <map>
#include <string>

#include "components/capabilities/carried.hpp"
#include "couplers/advection/dispersion.hpp"
#include "framework/config/data.hpp"
#include "framework/config/spec.hpp"

namespace sprekk::couplers {

/// Fluid that is injected at a place of the scene.
struct Injected {
  Origin origin;
  Data value;
};

/// The parameters of the advection of something.
struct AdvectionOptions {
  double per_volume = 1;  ///< what fluid holds per volume and value; heat: J/(m^3 K)
  Dispersivity dispersivity;
  std::map<std::string, Injected> injected;  ///< by the name of the place in the flow
  std::string scheme = "upwind";             ///< of the values at faces
  bool is_limited() const { return scheme == "limited"; }
  void declare_scheme(Spec& spec, const Carried& carried);
  void declare_injected(Spec& spec, const Carried& carried);
};

/// The parameters of heat_advection.
struct HeatAdvectionOptions : AdvectionOptions {
  Spec spec();
};

/// The parameters of tracer_advection.
struct TracerAdvectionOptions : AdvectionOptions {
  Spec spec();
};

}  // namespace sprekk::couplers
