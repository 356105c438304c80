// Components and couplers, as the schedule sees them.
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
#include "framework/field/known_within_cells.hpp"
#include "framework/field/output_field.hpp"
#include "framework/output/profile_entry.hpp"

namespace sprekk {

struct MeshChange;

/// The totals of one conserved quantity since the start of the run, which fulfil stored + outflow = injected.
struct Balance {
  double stored = 0, injected = 0, outflow = 0;
  /// Sum of the absolute amounts that were stored, injected or flowed out, place by place: errors are compared with it.
  double throughput = 0;
  std::string unit;
  bool is_closed = true;  ///< false where prescribed values replace a balance, which lets an unknown amount in
};

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

/// The diagonals that stabilize a split (see SolveStep): residual(row) += diagonal · (value − value at the solve's
/// start).
using Stabilization = std::map<const Field*, Vector>;

/// How the parts support an attempt of Newton's method. `with_shortcuts`: the first attempt, with all shortcuts that
/// make most steps quick. `without_shortcuts`: an attempt after a failure. `piecewise`: the discrete state
/// distinguishes all pieces of piecewise linear terms, and derivatives are those of the piece in which the values are,
/// not of the piece in which the update is expected. `piecewise_linear`: the same, and coefficients that make terms
/// nonlinear within a piece keep the values that they have at the moment of the call.
enum class SearchMode { with_shortcuts, without_shortcuts, piecewise, piecewise_linear };

/// A component or a coupler, as the schedule sees it. Repeating a step after a rewind must give the same bits: whatever
/// a part keeps between calls is in fields, or follows from the mesh, the parameters and the time of the step.
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

  /// Called after the fields have been accepted or rewound, for state that is not in fields.
  virtual void accepted() {}
  virtual void rewound() {}
  /// Adds what the part knows of the accepted values of a field within cells, beside their means. New cells take it
  /// over when the mesh changes (transferred_cells).
  virtual void add_known_within_cells(const Field& /*field*/, KnownWithinCells& /*known*/) const {}
  /// Called on a part that has been built on a changed mesh, after its fields have received their values. Copies the
  /// state outside of fields from `before`, the same part on the old mesh, and gives new entities their initial state.
  virtual void carry_over(const Part& /*before*/, const MeshChange& /*change*/) {}
  /// Called when the equilibrium on the new mesh has been found, before it is accepted.
  virtual void settled(const MeshChange& /*change*/) {}
  /// For checkpoints: `save` adds state that is not in fields as named values, `restore` reads these values.
  virtual void save(std::map<std::string, Vector>& /*state*/) const {}
  virtual void restore(const std::map<std::string, Vector>& /*state*/) {}

  /// Keeps the cumulative balances (derived fields) of the fields that a `solve` has just determined: what was stored,
  /// what flowed out.
  virtual void after_solve(const std::vector<Field*>& /*solved*/, const StepTime&) {}
  /// Adds this part's totals to those of the conserved quantities, by name.
  virtual void balance(std::map<std::string, Balance>&) const {}

  /// Whether a time step may have two stages (TimeScheme::sdirk2): all that is stored is a change since the accepted
  /// values, times coefficients at the end of the step, and all flows are those at its end. Then each stage is a step
  /// of backward Euler from accepted values that are extrapolated.
  virtual bool allows_stages() const { return false; }

  /// Changes whenever the discrete state (which cells stick, slip, are open) does; the cycle detector reads it.
  virtual std::uint64_t discrete_state() const { return 0; }
  /// Sets how the part supports Newton's method from now on.
  virtual void set_search_mode(SearchMode) {}
  /// Holds the coefficients that make terms nonlinear within a piece at their values now, c_0, until they are released.
  virtual void hold_coefficients() {}
  /// From now on held coefficients are c_0^(1 − share) c^share with the current value c; with a share of 1 they are no
  /// longer held.
  virtual void release_coefficients(double /*share*/) {}
  /// Moves the fields to where one-sided conditions (contact) are inactive, so that the unknowns that these conditions
  /// hold are free.
  virtual void deactivate_conditions() {}
  /// Finds cells that have left their discrete state in this step by a jump although they could have stayed, and keeps
  /// them in that state from now on, whatever their conditions are. Returns their number.
  virtual int keep_states() { return 0; }
  /// Releases kept cells whose conditions are violated at the present values, and returns their number.
  virtual int release_violated() { return 0; }
  /// Releases all kept cells.
  virtual void release_kept() {}
  /// The names of the stabilizations that the part offers to split schemes.
  virtual std::vector<std::string> stabilizations() const;
  /// Adds the diagonals of a named stabilization for the fields that the part can stabilize.
  virtual void stabilize(const std::string& /*scheme*/, Stabilization&) const {}
  /// Pairs of components of which the first cannot be in a solve without the second.
  virtual std::vector<Dependence> dependences() const;
  /// Declares which unknowns float by a constant, and what holds or ties them.
  virtual void hold_constants(ConstantModes&) const {}
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
  /// How often something was computed or reused, for the end-of-run table: name → count.
  virtual std::map<std::string, long> counts() const;
  /// Entries of the end-of-run table for the part's own work inside of steps, without the work of the schedule's
  /// solvers.
  virtual std::vector<ProfileEntry> efforts() const;
};

/// Begins a step of all parts. All data come first: what one part discretizes may depend on properties of another.
void begin_step(const std::vector<Part*>& parts, const StepTime& step);

}  // namespace sprekk
