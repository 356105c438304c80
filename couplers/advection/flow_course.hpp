// The rates of fluid over a time step, for each substep in which the flow was solved.
#pragma once

#include <vector>

#include "components/capabilities/fluid_fluxes.hpp"
#include "framework/assembly/step_time.hpp"

namespace sprekk::couplers {

/// Rates of one kind (through faces, walls or ridges, or of wells; units as in FlowRates), and the sources that belong
/// to the flow.
struct FluidRates {
  Vector values;
  std::vector<FluidSource> sources = {};
};

/// Rates belong to the time step of the solve that has found them: the whole step, or a substep of it. So transport
/// that is solved while the flow is held gets the rates of its own step or substep.
class FlowCourse {
 public:
  /// To be called after each solve of the flow; `part`: its step or substep. Earlier rates for this time are dropped.
  void add(const StepTime& part, FluidRates rates);
  /// The rates in a step: those of the part that contains it, or the mean over its parts. They are valid until the next
  /// call of any function. nullptr if the flow has not been solved in any part of it.
  const FluidRates* over(const StepTime& step) const;
  void clear();

 private:
  struct Part {
    double from, to;  ///< s
    FluidRates rates;
  };
  /// The overlap of both in time, s; 0 where they only touch.
  static double shared(const Part& part, const StepTime& step);

  std::vector<Part> parts_;  ///< without overlaps
  mutable FluidRates mean_;
  mutable StepTime mean_over_;  ///< with a length of 0 where there is none
};

}  // namespace sprekk::couplers
