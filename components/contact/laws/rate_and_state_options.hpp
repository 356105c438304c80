// Parameters of friction that depends on slip rate and state.
#pragma once

#include <optional>

#include "framework/config/spec.hpp"

namespace sprekk::contact {

/// Parameters of RateAndStateLaw without f_0, of the start, of the step size, and of events.
struct RateAndStateOptions {
  Data a, b;
  Data distance;                          ///< L, m
  double reference_rate = 0;              ///< V_0, m/s
  std::optional<Data> initial_state;      ///< theta, s
  std::optional<Data> initial_slip_rate;  ///< m/s; theta = L/V
  double wave_speed = 0;                  ///< m/s, of shear waves
  bool is_damped = false;                 ///< whether the scene asks for radiation damping
  double state_change = 0.1;              ///< over L
  double event_slip_rate = 1e-3;          ///< m/s: between creep and the slip rates of earthquakes
  Spec spec();
};

}  // namespace sprekk::contact
