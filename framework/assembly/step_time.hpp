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

/// The time (s) at which backward Euler takes a datum: the end of the step, or just before it if the datum jumps there
/// (Data::switch_times). For dt = 0, before the first step, the end.
double time_in_step(const Data& data, const StepTime& step);
/// The value at that time. `place.t` is not read.
double value_in_step(const Data& data, Place place, const StepTime& step);
Point value_in_step(const VectorData& data, const Place& place, const StepTime& step);

}  // namespace sprekk
