// The interface of a component with fractures that can grow, for `grow` steps.
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "framework/assembly/step_time.hpp"
#include "framework/remeshing/extend_fractures.hpp"

namespace sprekk {

class Growing;

/// Thrown by examine(), examine_followed() and grow() if they find no answer in the present state: the step then counts
/// as not converged.
class UnsolvedGrowth : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Searches for the advance of all tips in one time step: the condition of growth is to hold in the state at the end of
/// the step, on the mesh with this advance. Usage: build the trial mesh with paths(), run the step on it, and let the
/// search learn from it, until the advance is found or refused.
class FrontSearch {
 public:
  virtual ~FrontSearch() = default;
  /// again: another trial is needed; found: the last trial is the step; refused: the step is too long, or no advance
  /// was found.
  enum class Verdict { again, found, refused };

  /// The paths of the next trial, from the mesh at the start of the step; empty where nothing grows.
  virtual const std::vector<PathExtension>& paths() const = 0;
  /// `trial`: the same component after the step on the mesh with these paths, with examine_followed(). After `found`
  /// the other tips grow in this state, by examine() and grow(), and conclude() tells whether the trial is the step.
  virtual Verdict learn(Growing& trial, const StepTime& step) = 0;
  /// After `found` the trial is the one to go on with; `again` where a tip that has grown now is to be searched for,
  /// too.
  virtual Verdict conclude(Growing& trial, const StepTime& step) = 0;
  /// To be called if the mesh cannot follow a path (an index into paths()). `again`: in the next trial its tip has
  /// stopped for good, or jumps less far; `refused`: the step is too long, since the mesh could follow earlier paths of
  /// the search.
  virtual Verdict give_up(int path, const std::string& why) = 0;
  /// To be called if the step with the last paths could not be solved. Returns whether there are other paths, with less
  /// growth, to try.
  virtual bool retreat() = 0;
  virtual std::string reason() const = 0;  ///< why the step was refused
  virtual double retry_dt() const = 0;     ///< s, of the step to try instead; 0: no suggestion
};

/// A path by which a fracture has grown, and which is not in the mesh yet.
struct PendingPath {
  int fracture;
  std::vector<Point> points;  ///< m, from the end of the fracture in the mesh on
};

/// The interface of a component with fractures that can grow: the load of its tips, and growth.
class Growing {
 public:
  static constexpr const char* promise = "has fractures that can grow";
  virtual ~Growing() = default;

  /// How near the tips are to growth, at the current values of the fields.
  struct Load {
    double now = 0;             ///< the largest of all tips; a tip grows from 1 on
    double accepted = 0;        ///< the same at the start of the step
    double onset = 0;           ///< the largest of those tips that have not grown yet
    double onset_accepted = 0;  ///< the same at the start of the step
    /// Largest relative change over the step of the state at the tips that a growth event disturbs.
    double unsettled = 0;
    /// The part of this change that the rate of the last step does not predict: 0 if the state changes at a constant
    /// rate, as under an injection. At most `unsettled`.
    double uneven = 0;
  };
  /// Throws InputError if no part gives it the loads of its tips.
  virtual void require_loads() const {}
  virtual Load examine(const StepTime& step) = 0;
  /// Examines only the tips that search_front() deals with; the others do not matter in trials.
  virtual void examine_followed(const StepTime& step) = 0;
  /// The growth of all tips in a step.
  struct Growth {
    std::vector<PathExtension> extensions;  ///< the paths that the mesh is to take over
    bool arrested = true;                   ///< whether all tips came to rest before the mesh had to take paths over
    /// The largest load, as in Load::now, that a tip had before it grew in this step; 0 if none has grown.
    double load = 0;
  };
  /// Lets the tips grow until they arrest, or until the mesh must take their paths over. The component keeps a path
  /// that is too short for the mesh; such a path counts from the next step on, if this one is accepted. With growth
  /// within steps the mesh is to take over, after the step, only paths that join another fracture.
  virtual Growth grow(const StepTime& step) = 0;
  /// Whether growth is found within steps if the scene does not say.
  virtual bool may_grow_within_steps() const = 0;
  /// To be called once: from then on growth is found within steps (search_front), unless the mesh cannot follow it.
  virtual void grow_within_steps() = 0;
  /// With growth within steps: from now on all tips grow with the state held, by grow(), if `is_held`, and by
  /// search_front() otherwise.
  virtual void hold(bool is_held) = 0;
  /// Whether the load of a tip is so far above that of growth that its growth is not continuous in time. To be called
  /// after examine().
  virtual bool is_far_above() const = 0;
  /// Whether tips that grew in the last step are assumed to grow in this one, so that this step need not be solved
  /// without growth first.
  virtual bool grows_on() const = 0;
  /// The longest step, s, over which the search follows growth at the speed of the last step; infinity where nothing
  /// grew.
  virtual double longest_step() const = 0;
  /// The search for growth within a step, or none when no tip is to grow. `goes_on`: the present state is that at the
  /// start of the step, and tips that grew in the last step grow in the first trial (grows_on()); otherwise the step
  /// has been solved without growth, and examine() has been called. The search remembers what it needs of the present
  /// state; it must not outlive this component. Where the step may not become shorter, growth that is too far or not
  /// found to the last digit is taken, with a note.
  virtual std::unique_ptr<FrontSearch> search_front(const StepTime& step, bool may_shrink, bool goes_on) = 0;
  /// Gives `other` (the same component in the same state on other cells), with which the trials continue, what a search
  /// has learnt for its next trial.
  virtual void prepare(Growing& /*other*/) const {}
  /// The paths that the mesh has not taken over yet, in the current state.
  virtual std::vector<PendingPath> pending_paths() const { return {}; }
  /// How the mesh changes around a path that it takes over.
  virtual CavityOptions cavity() const = 0;
  /// A hash of the topology of the meshes that the component itself keeps; 0 if it keeps none.
  virtual std::uint64_t topology() const { return 0; }
  /// Whether the systems that settle a state after growth may be so nearly singular that the fast solver for small
  /// systems loses digits.
  virtual bool settling_costs_digits() const { return false; }
};

/// A component whose fractures cannot grow: it gives the reason to a user who names it in a `grow` step.
class NotGrowing {
 public:
  virtual ~NotGrowing() = default;
  virtual std::string why_no_growth() const = 0;
};

}  // namespace sprekk
