// A node of the schedule tree. Every node is a step, so that schemes nest.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "framework/assembly/part.hpp"
#include "framework/linear/linear_solver.hpp"
#include "framework/schedule/status.hpp"

namespace sprekk {

/// One row of coupling.csv.
struct IterationRecord {
  StepTime time;
  std::string step;  ///< which node of the schedule: "solve pore rock", "iterate", …
  int iteration = 0;
  double residual = 0;     ///< the largest relative residual of any equation
  std::string equation;    ///< the equation with that residual
  double update = 0;       ///< relative; 0 where none is computed
  double step_length = 1;  ///< of the line search; negative where a path turns against the update
  /// Of each equation: its name, its largest residual over the magnitude of its terms.
  std::vector<std::pair<std::string, double>> residuals = {};
  int pass = 0;  ///< of the innermost iteration around the step; 0 without one
};
using IterationLog = std::function<void(const IterationRecord&)>;

/// A node of the schedule: advances the fields that it solves for over a time step.
class ScheduleStep {
 public:
  virtual ~ScheduleStep() = default;
  /// Advances its fields' current values to the end of the time step. Never throws for lack of convergence.
  virtual StepStatus run(const StepTime& step) = 0;
  /// The same, but a sequence of steps ends with the first one after which `is_enough` returns true.
  virtual StepStatus run_until(const StepTime& step, const std::function<bool()>& /*is_enough*/) { return run(step); }
  /// The fields that this step, or a step inside it, solves for.
  virtual std::vector<const Field*> unknowns() const = 0;
  /// How many systems a time step solves in turn, each without the results of later ones: more than one is a split
  /// without iteration.
  virtual int systems_in_turn(const StepTime& step) const = 0;
  /// The fields of the first of these systems.
  virtual std::vector<const Field*> solved_first(const StepTime& step) const {
    return systems_in_turn(step) > 0 ? unknowns() : std::vector<const Field*>();
  }
  /// Whether it solves for the field in a time step: a `when` may leave it out.
  virtual bool solves(const Field& field, const StepTime&) const { return std::ranges::count(unknowns(), &field) > 0; }
  /// Whether it, or a step inside it, solves with a stabilization.
  virtual bool is_stabilized() const {
    return std::ranges::any_of(children(), [](const ScheduleStep* child) { return child->is_stabilized(); });
  }
  /// Throws InputError for options that have no effect. Called when all parts have data.
  virtual void check() const {
    for (const ScheduleStep* child : children()) child->check();
  }
  /// Throws InputError if nothing determines the constant mode of some balances in a system of the first time step,
  /// which would fail there. Called when all parts have begun this step. Collective.
  virtual void require_held(const StepTime& step) const {
    for (const ScheduleStep* child : children()) child->require_held(step);
  }
  /// Tells the step the unknowns of the iteration around it: those that it does not solve for wait meanwhile.
  virtual void iterate_with(const std::vector<const Field*>& /*unknowns*/) {}
  /// Adds notes on a step that is about to be accepted, if it was solved in another way than the scene says.
  virtual void note_step(Notes& notes, const StepTime& step) const {
    for (const ScheduleStep* child : children()) child->note_step(notes, step);
  }
  /// The largest error of a balance over its throughput that an accepted step may have; infinite if an iteration ends
  /// by conditions on changes only.
  virtual double largest_imbalance() const {
    double largest = 0;
    for (const ScheduleStep* child : children()) largest = std::max(largest, child->largest_imbalance());
    return largest;
  }
  /// The factor by which the error of an amount over the step may exceed that of one solve: the errors of successive
  /// solves inside add up.
  virtual double summed_errors() const {
    double largest = 1;
    for (const ScheduleStep* child : children()) largest = std::max(largest, child->summed_errors());
    return largest;
  }
  /// One line for the graph and for messages.
  virtual std::string describe() const = 0;
  virtual std::vector<const ScheduleStep*> children() const { return {}; }
  /// Adds the counts of the linear solvers in this step and in the steps inside of it.
  virtual void add_counts(LinearCounts& counts) const = 0;
};

}  // namespace sprekk
