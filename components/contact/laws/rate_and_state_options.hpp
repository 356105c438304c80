// What a scene says of friction that depends on slip rate and state.
#pragma once

#include <optional>

#include "framework/config/spec.hpp"

namespace sprekk::contact {

/// Parameters of RateAndStateLaw, without f_0, and of what follows from it.
struct RateAndStateOptions {
  Data a, b;
  Data distance;                          ///< L, m
  double reference_rate = 0;              ///< V_0, m/s
  std::optional<Data> initial_state;      ///< theta, s
  std::optional<Data> initial_slip_rate;  ///< m/s; theta = L/V
  double wave_speed = 0;                  ///< m/s, of shear waves
  bool is_damped = false;                 ///< whether the scene has the section
  double state_change = 0.1;              ///< over L
  double event_slip_rate = 1e-3;          ///< m/s
  Spec spec();
};

}  // namespace sprekk::contact
