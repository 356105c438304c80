// The trial state of a cell.
#pragma once

#include <optional>

#include "components/contact/laws/strength.hpp"
#include "components/contact/return_map.hpp"
#include "framework/types.hpp"

namespace sprekk::contact {

/// The gap of a cell, m, the strength of its walls, Pa, and the trial traction for the return map, Pa.
struct Trial : TrialTraction<dimension - 1> {
  double gap;
  double gap_by_traction;           ///< d gap / d f_n, m/Pa
  TangentialVector slip_direction;  ///< unit
  double dilation;                  ///< d gap / d [u]_t = −dilation · slip_direction^T
  Strength strength;
  double path;                    ///< at the end of the step, m; 0 without weakening
  TangentialVector path_by_slip;  ///< d path / d [u]_t where the gap is held
  double path_by_gap;
  double bound_by_pressure;        ///< d bound / d (−normal) where the walls touch
  TangentialVector bound_by_slip;  ///< d bound / d [u]_t where normal and path are held; only with a formula
  double least_bound;  ///< a smaller bound counts as no friction: the direction of its traction is round-off
  /// The traction of walls whose friction depends on the slip rate; nothing for other friction, which has a cone.
  struct AtRate {
    ReturnedTraction<dimension - 1> traction;
    TangentialVector by_pressure = TangentialVector::Zero();  ///< d traction / d (−normal) where the walls touch
    TangentialVector slip_rate = TangentialVector::Zero();    ///< m/s
  };
  std::optional<AtRate> at_rate;
  /// Whether the cell slides towards zero slip, against friction.
  bool slides_back() const {
    return bound > least_bound && !is_open() && !sticks() && tangential.dot(slip_direction) < 0;
  }
};

/// The size of the slip in a step, m, and its derivative by [u]_t.
struct SlipOfStep {
  double size;
  TangentialVector by_jump;
  double below_zero = 0;  ///< m, negative where the slip opposes `by_jump`: laws continue linearly there
  bool is_first = false;  ///< whether the walls have not slid before, so that this is their whole slip, too
};

}  // namespace sprekk::contact
