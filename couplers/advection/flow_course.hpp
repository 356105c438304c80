// The rates of fluid over a time step, part by part as the flow was solved for.
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

/// Rates hold over the time step of the solve that has found them: the whole step, or a substep of it. So what carries
/// something with the fluid while the flow is held knows which rates belong to its own step or substep.
class FlowCourse {
 public:
  /// To be called after each solve of the flow; `part`: its step. What was found for this time before is forgotten.
  void add(const StepTime& part, FluidRates rates);
  /// The rates in a step: those of the part that it lies in, or the mean over its parts. The values stay until the
  /// next call of any function. nullptr where the flow has not been solved for any part of it.
  const FluidRates* over(const StepTime& step) const;
  void clear();

 private:
  struct Part {
    double from, to;  ///< s
    FluidRates rates;
  };
  /// The length of time that both share, s; 0 where they only touch.
  static double shared(const Part& part, const StepTime& step);

  std::vector<Part> parts_;  ///< without overlaps
  mutable FluidRates mean_;
  mutable StepTime mean_over_;  ///< with a length of 0 where there is none
};

}  // namespace sprekk::couplers
