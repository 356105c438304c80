#include "framework/schedule/solve_step.hpp"

#include <algorithm>

#include "framework/assembly/stabilizes_preconditioner.hpp"
#include "framework/invariants.hpp"

namespace sprekk {

namespace {

void require_offered(const SolveOptions& options, const std::vector<Part*>& parts) {
  std::vector<std::string> offered = {"none"};
  for (const Part* part : parts) {
    const std::vector<std::string> more = part->stabilizations();
    for (const std::string& name : more)
      if (std::ranges::count(offered, name) == 0) offered.push_back(name);
  }
  if (std::find(offered.begin(), offered.end(), options.stabilization) == offered.end())
    throw unknown_name(options.stabilization_origin, "stabilization", options.stabilization, offered);
}

void require_together(const SolveOptions& options, const std::vector<Part*>& parts) {
  const auto is_solved = [&](const std::string& name) {
    return std::find(options.components.begin(), options.components.end(), name) != options.components.end();
  };
  for (const Part* part : parts)
    for (const Dependence& dependence : part->dependences())
      if (is_solved(dependence.component) && !is_solved(dependence.on))
        throw InputError(options.origin, "'" + dependence.component + "' is solved without '" + dependence.on + "'",
                         dependence.because, "name both in one 'solve'");
}

/// The pairs of fields of a stabilization that are both solved for.
std::vector<Following> followers(const std::string& stabilization, const std::vector<Part*>& parts,
                                 const std::vector<Field*>& solved) {
  std::vector<Following> pairs;
  if (stabilization == "none") return pairs;
  for (const Part* part : parts) {
    const auto* follows = dynamic_cast<const FollowsWaiting*>(part);
    if (!follows) continue;
    for (const Following& pair : follows->following(stabilization))
      if (std::ranges::count(solved, pair.row) > 0 && std::ranges::count(solved, pair.column) > 0)
        pairs.push_back(pair);
  }
  return pairs;
}

}  // namespace

Spec newton_spec(NewtonOptions& options) {
  Spec spec("newton", "Semismooth Newton's method of a simultaneous system.");
  spec.quantity(
      "residual", options.residual,
      {.range = strictly_between(0, 1), .doc = "Largest residual of an equation over the largest of its terms."});
  spec.quantity("update", options.update,
                {.range = strictly_between(0, 1), .doc = "Largest next change of a field over its largest value."});
  spec.integer("at_most", options.at_most,
               {.range = between(1, 1000), .doc = "Iterations before the step is refused."});
  spec.integer("undamped", options.undamped,
               {.range = between(0, 1000), .doc = "Iterations before the line search asks for descent."});
  spec.integer("pieces", options.pieces,
               {.range = between(0, 100000),
                .doc = "When that does not converge, the path from piece to piece of piecewise linear conditions is "
                       "followed, through at most so many; 0 for never."});
  return spec;
}

Spec solver_spec(LinearOptions& options) {
  Spec spec("solver", "The solver of linear systems.");
  spec.choice(
      "type", options.type,
      {{"auto", "UMFPACK for small systems, MUMPS for larger ones and several processes, Belos for very large ones"},
       {"umfpack", "sparse direct, one process"},
       {"mumps", "sparse direct, any number of processes"},
       {"belos", "GMRES with a block preconditioner, stabilized as couplers offer it, and multigrid inside"}},
      {.doc = "Which solver."});
  spec.quantity("tolerance", options.tolerance,
                {.range = strictly_between(0, 1), .doc = "Relative residual of an iterative solver."});
  spec.integer("max_iterations", options.max_iterations,
               {.range = between(1, 100000), .doc = "Iterations of an iterative solver."});
  spec.flag(
      "condense", options.condense,
      {.doc = "Factorizes the equations of the bulk once for a mesh and a time step, and solves in each iteration "
              "for what is on fractures only. Direct solvers in one process."});
  return spec;
}

Spec SolveOptions::spec() {
  Spec spec("solve",
            "Solves for the unknowns of the named components simultaneously. All their terms count; "
            "fields that are not unknowns here keep their latest values.");
  spec.texts("solve", components, {.doc = "Names of components.", .required = true});
  spec.text("stabilize", stabilization,
            {.doc = "A stabilization that a coupler offers for split schemes (its page names it); or none."});
  spec.section("newton", newton_spec(newton), {.doc = "Overrides the scene's `newton:`."}, &overrides_newton);
  spec.section("solver", solver_spec(linear), {.doc = "Overrides the scene's `solver:`."}, &overrides_linear);
  return spec;
}

SolveStep::SolveStep(const SolveOptions& options, const ScheduleContext& context)
    : options_(options),
      parts_(context.parts),
      fields_(context.solved_fields(options.components)),
      mesh_(context.mesh),
      newton_(context.mesh, fields_, context.parts, options.linear, options.newton, describe(), context.log) {
  require_offered(options, context.parts);
  require_together(options, context.parts);
}

std::string SolveStep::describe() const {
  std::string text = "solve";
  for (const std::string& name : options_.components) text += " " + name;
  return text;
}

const std::vector<ResponseTerm>& SolveStep::responses(const StepTime& step) {
  static const std::vector<ResponseTerm> none;
  if (!is_response_made_) {
    is_response_made_ = true;
    const std::vector<Following> pairs = followers(options_.stabilization, parts_, fields_);
    std::vector<const Field*> waiting;
    for (const Field* field : iterated_)
      if (std::ranges::count(fields_, field) == 0) waiting.push_back(field);
    if (!pairs.empty() && !waiting.empty())
      response_ = std::make_unique<WaitingResponse>(mesh_, waiting, parts_, pairs, options_.linear);
  }
  return response_ ? response_->update(step) : none;
}

void SolveStep::check() const {
  if (options_.stabilization == "none") return;
  Stabilization stabilization;
  for (const Part* part : parts_) part->stabilize(options_.stabilization, stabilization);
  const auto is_solved = [&](const auto& entry) { return std::ranges::count(fields_, entry.first) > 0; };
  if (stabilization.empty() || std::ranges::any_of(stabilization, is_solved)) return;
  if (!followers(options_.stabilization, parts_, fields_).empty()) return;
  throw InputError(options_.stabilization_origin, "'stabilize: " + options_.stabilization + "' has no effect here",
                   "it is for " + stabilization.begin()->first->name() + ", which this step does not solve for",
                   "give it to the 'solve' of '" + stabilization.begin()->first->spec().owner + "'");
}

StepStatus SolveStep::run(const StepTime& step) {
  SPREKK_EXPECT(step.dt > 0 && step.end > step.start, step.start, step.dt, step.end);
  Stabilization stabilization, preconditioning;
  for (const Part* part : parts_) {
    if (const auto* offer = dynamic_cast<const StabilizesPreconditioner*>(part))
      offer->stabilize_preconditioner(preconditioning);
    if (options_.stabilization != "none") part->stabilize(options_.stabilization, stabilization);
  }
  newton_.set_preconditioner_stabilization(preconditioning);
  const StepStatus status = newton_.solve(step, stabilization, responses(step));
  if (status.converged)
    for (Part* part : parts_) part->after_solve(fields_, step);
  return status;
}

void SolveStep::add_counts(LinearCounts& counts) const {
  counts += newton_.counts();
  if (response_) counts += response_->counts();
}

}  // namespace sprekk
