// The interval of a time step, and which value of changing data holds in it.
#pragma once

#include "framework/config/data.hpp"

namespace sprekk {

/// The time interval that a step advances over.
struct StepTime {
  double start = 0;  ///< s
  double dt = 0;     ///< s
  double end = 0;    ///< s; start + dt, or the exact target when a step was cut to hit one
};

/// The datum as backward Euler takes it: at the end of the step; where it jumps there (Data::switch_times), the value
/// that held until then. Without a length (dt = 0, before the first step) the step has the value that holds from its
/// end on. `place.t` is not read.
double value_in_step(const Data& data, Place place, const StepTime& step);
Point value_in_step(const VectorData& data, const Place& place, const StepTime& step);

}  // namespace sprekk
