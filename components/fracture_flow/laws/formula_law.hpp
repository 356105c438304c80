// A transmissivity that is a formula of the state.
#pragma once

#include <array>

#include "components/fracture_flow/laws/hydraulic_law.hpp"
#include "framework/assembly/state_fields.hpp"

namespace sprekk::fracture_flow {

/// The variables that a formula of the transmissivity may name; the aperture is the first.
const StateVariables& conduction_variables();
/// Their places in ConductionState.
enum ConductionVariable : std::size_t {
  of_aperture,
  of_pressure,
  of_temperature,
  of_normal_stress,
  conduction_variable_count
};
using ConductionState = std::array<double, conduction_variable_count>;

/// The hydraulic aperture by a formula, and its derivatives by all variables.
struct HydraulicState {
  double value;        ///< m
  ConductionState by;  ///< m over the unit of each variable
};

/// h from h^3 = 12 K with the transmissivity K (m^3) of the formula, but not below `lowest`. The aperture in the
/// formula is not below `lowest` either, so that closed walls do not divide by zero.
HydraulicState hydraulic_state(const StateFormula& formula, int cell, double lowest, ConductionState state);

}  // namespace sprekk::fracture_flow
