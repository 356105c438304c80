// The choice of the next time step.
#pragma once

#include <list>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/assembly/part.hpp"
#include "framework/config/spec.hpp"
#include "framework/schedule/time_scheme.hpp"

namespace sprekk {

/// Parameters of a scene's `time:`.
struct TimeOptions {
  double start = 0;  ///< s
  double end = 0;    ///< s
  double step = 0;   ///< s, size of the first step and, unless adaptive, of all
  std::string scheme_name = "backward_euler";
  TimeScheme scheme = TimeScheme::backward_euler;  ///< the scheme of this name
  Origin scheme_origin;
  std::optional<double> smallest;  ///< s; a rejected step is not cut below it
  bool adaptive = false;
  double largest = 0;               ///< s, of adaptive steps
  double grow = 1.5, shrink = 0.5;  ///< of adaptive steps; tried on ten days of configs/tutorial/first_scene.yaml
  /// A column of history.csv that has reached a value.
  struct StopTerm {
    std::optional<std::string> of = {};        ///< the quantity, without its unit
    std::optional<std::string> reaches = {};   ///< from below, with its unit
    std::optional<std::string> falls_to = {};  ///< from above; one of the two is given
    Origin origin = {};
    void declare(Spec& spec);
    void check(const Node& node);
  };
  /// Ends the run before `end`, after the first step at whose end its terms hold.
  struct Stop {
    StopTerm only;                 ///< without `all` and `any`
    std::list<StopTerm> all, any;  ///< which of them is given
    Spec spec();
    std::list<StopTerm> terms() const { return !all.empty() ? all : !any.empty() ? any : std::list{only}; }
  };
  Stop stop;
  bool has_stop = false;
  std::optional<double> stop_when_steady;  ///< see spec
  int iterations = 8;  ///< adaptive steps grow while no solve needs more than half of these, and shrink beyond them
  Spec spec();
};

/// The memory of a step that failed: its size is not tried again before `wait` steps have been accepted.
struct FailedStep {
  double size = 0;   ///< s, 0 for none
  int wait = 0;      ///< accepted steps until the size may be tried again
  int patience = 3;  ///< the first value of `wait`; it doubles each time the size fails again
};

/// The prediction of the next hold, for events that recur: steps are held small each time that a level (a load, say)
/// has risen to 1.
struct Recurrence {
  std::optional<double> released = std::nullopt;  ///< s, the time of the last release
  double level = 0;                               ///< at the last release
  double pause = 0;                               ///< s, from a release to the next hold; 0 as long as unknown
  double rise = 1;                                ///< of the level in that pause
  std::optional<double> expected = std::nullopt;  ///< s, the time of the next hold
  double patience = 0;                            ///< s, the last delay of a hold that is overdue
};

/// Chooses constant or adaptive steps that end exactly at the targets (output times, switches of sources, the end). A
/// rejected step is repeated with a smaller size; afterwards sizes grow back by the factor `grow` a step, but not at
/// once to the size that has failed.
class StepController {
 public:
  /// `targets`: times (s) that a step must end at, in any order; those outside of the run are ignored.
  StepController(const TimeOptions& options, std::vector<double> targets);

  bool is_finished() const { return time_ >= options_.end; }
  double time() const { return time_; }
  int steps() const { return steps_; }
  double smallest() const;                   ///< s, of rejected steps
  double wanted() const { return wanted_; }  ///< s, the size of the next step unless a target or a hold comes before
  StepTime next() const;
  /// The same, but no longer than `longest` (s, positive). What is left to the next target is divided into equal parts,
  /// so that no tiny step is left before it; if such a part is no longer than the smallest step, the step is as long as
  /// it may be.
  StepTime next(double longest) const;

  void accepted(const StepTime& step, int iterations);
  /// Makes the next step shorter: `retry` (s), if that is given. Returns false when no shorter step is allowed.
  bool rejected(const StepTime& step, double retry = 0);
  /// Holds all steps at this size (s) until `release`. Then the standard size returns, but a step ends when the next
  /// hold is expected; such a step has at least a tenth of the standard size. A hold begins when the level is 1; the
  /// level is assumed to rise as fast as in the last pause, from a release to the next hold.
  void hold(double step, double level);
  void release(double level);
  /// Holds and releases steps for events that are not expected to recur.
  void hold(double step);
  void release();
  /// Takes the level after a step. A hold that is overdue gets a new expected time, from the rise since the release,
  /// but after at least twice the last delay: a level may come to rest below 1.
  void observe(double level);
  double held() const { return held_; }  ///< s, 0 when nothing is held
  const FailedStep& failed() const { return failed_; }

  /// For checkpoints: `save` adds all values that the controller keeps, by name, and `restore` takes them back (as
  /// KeepsState does). `restore` throws InputError when a value is missing or is not one number; the controller must
  /// not be used after that.
  void save(std::map<std::string, Vector>& state) const;
  void restore(const std::map<std::string, Vector>& state);

 private:
  double grown() const;
  double shortest_wait() const;
  void remember_success(const StepTime& step);
  template <class Controller, class Visit>
  static void visit_values(Controller& controller, const Visit& visit);

  TimeOptions options_;
  FailedStep failed_;
  Recurrence recurrence_;
  std::vector<double> targets_;
  double time_, wanted_, held_ = 0;
  int steps_ = 0;
};

}  // namespace sprekk
