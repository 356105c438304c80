// The parameters of the laws of fracture flow.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "components/fracture_flow/laws/known_laws.hpp"
#include "framework/config/spec.hpp"

namespace sprekk::fracture_flow {

/// What a scene writes under `law`.
struct LawOptions {
  std::string type = "cubic";          ///< of hydraulic_laws()
  std::optional<double> residual;      ///< m
  std::optional<double> roughness;     ///< m
  std::optional<Data> transmissivity;  ///< m^3, of a constant one
  Data inertia;                        ///< 1/m, Forchheimer's coefficient
  LawChoice<HydraulicLaw, double> registered;
  Spec spec();
  /// `floor`: a further lower bound of the hydraulic aperture, m.
  std::unique_ptr<HydraulicLaw> make(double floor) const;
};

}  // namespace sprekk::fracture_flow
