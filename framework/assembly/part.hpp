// What every component and coupler is to the schedule.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "framework/assembly/assembly.hpp"
#include "framework/assembly/constant_modes.hpp"
#include "framework/assembly/notes.hpp"
#include "framework/assembly/step_time.hpp"
#include "framework/field/field_store.hpp"
#include "framework/field/output_field.hpp"
#include "framework/output/profile.hpp"

namespace sprekk {

struct MeshChange;

/// The totals of one conserved quantity since the start of the run: stored + outflow = injected.
struct Balance {
  double stored = 0, injected = 0, outflow = 0;
  /// Sum of the amounts over all places where one was stored, injected or flowed out: what errors are small against.
  double throughput = 0;
  std::string unit;
  bool is_closed = true;  ///< false where values are prescribed instead of the balance: they let an unknown amount in
};

/// A column of history.csv.
struct Quantity {
  std::string name, unit;
  double value;
};

/// The equations of one component that have no solution while another's unknowns are held.
struct Dependence {
  std::string component, on;  ///< names in the scene
  std::string because;
};

/// The diagonals that stabilize a split (see SolveStep): residual(row) += diagonal · (value − value at the solve's
/// start).
using Stabilization = std::map<const Field*, Vector>;

/// freely: at first. Carefully: when that has failed, so that what makes most steps quick may be left out. In pieces:
/// the discrete state tells all pieces of piecewise linear terms from one another, and derivatives are those of the
/// piece that the values are in, not of one where the update is expected. In linear pieces: as well, and coefficients
/// that make terms nonlinear within a piece stay what they are at the moment of the call.
enum class Look { freely, carefully, in_pieces, in_linear_pieces };

/// A component or a coupler. Repeating a step after a rewind must give the same bits: whatever a part keeps between
/// calls is in fields, or follows from the mesh, the parameters and the step's time.
class Part {
 public:
  virtual ~Part() = default;

  /// Evaluates the data that depend on time, as the step needs them (value_in_step), and nothing else. Called before a
  /// run for its last and its first step, so that data without a value there are refused. Throws DataError.
  virtual void evaluate_data(const StepTime&) {}
  /// Called when all parts have evaluated their data: rediscretizes what a changed mesh or property makes stale.
  virtual void begin_step(const StepTime& step) = 0;
  /// Adds all terms of all its equations; the assembly keeps what its solve needs.
  virtual void assemble(Assembly& assembly, const StepTime& step) const = 0;
  /// Fixes values that are prescribed where others have equations (Assembly::fix). Called after all parts have
  /// assembled.
  virtual void constrain(Assembly&) const {}

  /// Called after the fields have been accepted or rewound, for state that is not in fields.
  virtual void accepted() {}
  virtual void rewound() {}
  /// Called on a part that has been built on a changed mesh, after its fields have received their values: takes over
  /// the state of the part `before` that it replaces, and gives new entities their initial state.
  virtual void carry_over(const Part& /*before*/, const MeshChange& /*change*/) {}
  /// Called when the equilibrium on the new mesh has been found, before it is accepted.
  virtual void settled(const MeshChange& /*change*/) {}
  /// State that is not in fields, for checkpoints: adds named values, and takes them back.
  virtual void save(std::map<std::string, Vector>& /*state*/) const {}
  virtual void restore(const std::map<std::string, Vector>& /*state*/) {}

  /// Keeps the books (derived fields) of the fields that a `solve` has just determined: what was stored, what flowed
  /// out.
  virtual void after_solve(const std::vector<Field*>& /*solved*/, const StepTime&) {}
  /// Adds this part's totals to those of the conserved quantities, by name.
  virtual void balance(std::map<std::string, Balance>&) const {}

  /// Changes whenever the discrete state (which cells stick, slip, are open) does; the cycle detector reads it.
  virtual std::uint64_t discrete_state() const { return 0; }
  /// How Newton's method looks for a solution from now on.
  virtual void look_for_solution(Look) {}
  /// Holds the coefficients that make terms nonlinear within a piece at their values now, c_0, until they are released.
  virtual void hold_coefficients() {}
  /// Held coefficients are c_0^(1 − share) c^share from now on, c for a share of 1.
  virtual void release_coefficients(double /*share*/) {}
  /// Puts the fields to where conditions that hold on one side only do not hold, so that what they hold is free.
  virtual void loosen() {}
  /// The names of the stabilizations that it offers to split schemes.
  virtual std::vector<std::string> stabilizations() const { return {}; }
  /// Adds the diagonals of a named stabilization to the fields that it knows how to stabilize.
  virtual void stabilize(const std::string& /*scheme*/, Stabilization&) const {}
  /// Which components cannot be in a solve without which others.
  virtual std::vector<Dependence> dependences() const { return {}; }
  /// Says which potentials may be shifted by a constant, and what holds them.
  virtual void hold_constants(ConstantModes&) const {}
  /// Times (s) that a step must end at, because data jump there.
  virtual std::vector<double> switch_times() const { return {}; }
  /// Quantities for history.csv, and fields for pictures.
  virtual void report(std::vector<Quantity>&) const {}
  virtual void output(std::vector<OutputField>&) const {}
  /// Adds what can be known before the run: data without effect, data that contradict one another. `sprekk check` shows
  /// it, and a run at its start.
  virtual void note_input(Notes&) const {}
  /// Adds what a step did that its user would not expect. Called on all processes for each step that is about to be
  /// accepted, after report().
  virtual void note_step(Notes&, const StepTime&) const {}
  /// How often something was computed or reused, for the end-of-run table: name → count.
  virtual std::map<std::string, long> counts() const { return {}; }
  /// Entries of the end-of-run table for work of its own inside of steps, without that of the schedule's solvers.
  virtual std::vector<Profile::Entry> efforts() const { return {}; }
};

/// All data first: what a part discretizes may depend on properties of another.
inline void begin_step(const std::vector<Part*>& parts, const StepTime& step) {
  for (Part* part : parts) part->evaluate_data(step);
  for (Part* part : parts) part->begin_step(step);
}

}  // namespace sprekk
