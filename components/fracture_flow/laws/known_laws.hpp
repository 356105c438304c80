// The laws for the hydraulic aperture by name.
#pragma once

#include <memory>
#include <string>

#include "components/fracture_flow/laws/hydraulic_law.hpp"
#include "framework/scene/law_registry.hpp"

namespace sprekk::fracture_flow {

/// The parameters of all laws; each takes what it needs.
struct HydraulicLawParameters {
  double lowest = 0;     ///< m, lower bound of the hydraulic aperture; positive
  double roughness = 0;  ///< m, height of the asperities
};

/// Further laws, registered by plug-ins. They are built from the lower bound of the hydraulic aperture, m, which is
/// positive.
using HydraulicLaws = LawRegistry<HydraulicLaw, double>;
HydraulicLaws& hydraulic_laws();

/// The built-in law of this name, which follows from the aperture.
std::unique_ptr<HydraulicLaw> make_hydraulic_law(const std::string& name, const HydraulicLawParameters& parameters);

}  // namespace sprekk::fracture_flow
