// The interface of a component with fractures that can grow, for `grow` steps.
#pragma once

#include <vector>

#include "framework/assembly/step_time.hpp"
#include "framework/remeshing/extend_fractures.hpp"

namespace sprekk {

/// What a component with fractures that can grow offers to the schedule: the load of its tips, and growth.
class Growing {
 public:
  static constexpr const char* promise = "has fractures that can grow";
  virtual ~Growing() = default;

  /// How near the tips are to growth, from the current values of the fields.
  struct Load {
    double now = 0;             ///< the largest of all tips; a tip grows from 1 on
    double accepted = 0;        ///< the same at the start of the step
    double onset = 0;           ///< the largest of those tips that have not grown yet
    double onset_accepted = 0;  ///< the same at the start of the step
    double unsettled = 0;       ///< largest relative change over the step of what a growth event disturbs at the tips
  };
  virtual Load examine(const StepTime& step) = 0;
  /// What the tips have grown in a step.
  struct Growth {
    std::vector<PathExtension> extensions;  ///< the paths that the mesh is to take over
    bool arrested = true;                   ///< whether all tips came to rest before the mesh had to take paths over
  };
  /// Lets the tips grow until they arrest, or until the mesh must take their paths over. The component keeps a path
  /// that is too short for the mesh; such a path counts from the next step on, if this one is accepted.
  virtual Growth grow(const StepTime& step) = 0;
  /// How the mesh changes around a path that it takes over.
  virtual CavityOptions cavity() const = 0;
  /// Whether the systems that settle a state after growth may be so nearly singular that a solver which is quick for
  /// small systems loses digits.
  virtual bool settling_costs_digits() const { return false; }
};

}  // namespace sprekk
