// Components and couplers, as the schedule sees them.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "framework/assembly/assembly.hpp"
#include "framework/assembly/notes.hpp"
#include "framework/assembly/step_time.hpp"
#include "framework/field/field_store.hpp"
#include "framework/field/output_field.hpp"
#include "framework/output/profile_entry.hpp"

namespace sprekk {

/// The totals of one conserved quantity since the start of the run, which fulfil stored + outflow = injected.
struct Balance {
  double stored = 0, injected = 0, outflow = 0;
  /// Sum of the absolute amounts that were stored, injected or flowed out, place by place: errors are compared with it.
  double throughput = 0;
  std::string unit;
  bool is_closed = true;  ///< false where prescribed values replace a balance, which lets an unknown amount in
};

/// Adds the sums of a cumulative field over all entities, with the values of their owners. Its components are (stored,
/// outflow) or (stored, injected, outflow). Collective.
void add_totals(Balance& balance, const Mesh& mesh, const Field& cumulative);

/// A column of history.csv.
struct Quantity {
  std::string name, unit;
  double value;
};

/// States that the equations of `component` have no solution while the unknowns of the component `on` are held.
struct Dependence {
  std::string component, on;  ///< names in the scene
  std::string because;
  /// Whether the equations have a solution when the unknowns of `on` are not held, but follow by their Schur complement
  /// (WaitingResponse).
  bool ends_with_response = false;
};

/// A component or a coupler, as the schedule sees it. Repeating a step after a rewind must give the same bits: whatever
/// a part keeps between calls is in fields, or follows from the mesh, the parameters and the time of the step; else it
/// is a KeepsState. What few parts need are capabilities, classes that they inherit as well: PiecewiseSmooth,
/// KeepsState, FollowsMesh, Stabilizes, CountsWork and others beside this file.
class Part {
 public:
  virtual ~Part();

  /// Evaluates the data that depend on time for the step (value_in_step), and does nothing else. Also called before a
  /// run, for its last and its first step, to refuse data without a value there. Throws DataError.
  virtual void evaluate_data(const StepTime&) {}
  /// Called when all parts have evaluated their data: updates the discretizations after the mesh or properties have
  /// changed.
  virtual void begin_step(const StepTime& step) = 0;
  /// Adds all terms of all its equations; the assembly keeps what its solve needs.
  virtual void assemble(Assembly& assembly, const StepTime& step) const = 0;
  /// Fixes prescribed values in rows to which other parts add terms (Assembly::fix). Called after all parts have
  /// assembled.
  virtual void constrain(Assembly&) const {}

  /// Keeps the cumulative balances (derived fields) of the fields that a `solve` has just determined: what was stored,
  /// what flowed out.
  virtual void after_solve(const std::vector<Field*>& /*solved*/, const StepTime&) {}
  /// Adds this part's totals to those of the conserved quantities, by name.
  virtual void balance(std::map<std::string, Balance>&) const {}

  /// Whether a time step may have two stages (TimeScheme::sdirk2): all that is stored is a change since the accepted
  /// values, times coefficients at the end of the step, and all flows are those at its end. Then each stage is a step
  /// of backward Euler from accepted values that are extrapolated.
  virtual bool allows_stages() const { return false; }

  /// Pairs of components of which the first cannot be in a solve without the second.
  virtual std::vector<Dependence> dependences() const;
  /// Times (s) that a step must end at, because data jump there.
  virtual std::vector<double> switch_times() const;
  /// Quantities for history.csv, and fields for pictures.
  virtual void report(std::vector<Quantity>&) const {}
  virtual void output(std::vector<OutputField>&) const {}
  /// Adds notes on the input: data without effect, data that contradict one another. `sprekk check` shows them, and so
  /// does a run at its start.
  virtual void note_input(Notes&) const {}
  /// Adds notes on what the user of a run would not expect of a step. Called on all processes for each step that is
  /// about to be accepted, after report().
  virtual void note_step(Notes&, const StepTime&) const {}
};

/// The parts that have a capability, in their order.
template <class Capability>
std::vector<Capability*> parts_with(const std::vector<Part*>& parts) {
  std::vector<Capability*> found;
  for (Part* part : parts)
    if (auto* able = dynamic_cast<Capability*>(part)) found.push_back(able);
  return found;
}

/// Begins a step of all parts. All data come first: what one part discretizes may depend on properties of another.
void begin_step(const std::vector<Part*>& parts, const StepTime& step);

}  // namespace sprekk
