#include "framework/schedule/solve_step.hpp"

#include <algorithm>

#include "framework/assembly/assemble_all.hpp"
#include "framework/assembly/block_system.hpp"
#include "framework/assembly/needs_direct_solver.hpp"
#include "framework/assembly/stabilizes.hpp"
#include "framework/invariants.hpp"
#include "framework/outside/solved_outside.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/schedule/residual_check.hpp"

namespace sprekk {

namespace {

const char* const response = "response";  ///< the stabilization that needs no coupler to offer it

void require_offered(const SolveOptions& options, const std::vector<Part*>& parts) {
  std::vector<std::string> offered = {"none", response};
  for (const auto* part : parts_with<Stabilizes>(parts)) {
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
      if (is_solved(dependence.component) && !is_solved(dependence.on) &&
          !(dependence.ends_with_response && options.stabilization == response))
        throw InputError(options.origin, "'" + dependence.component + "' is solved without '" + dependence.on + "'",
                         dependence.because,
                         std::string("name both in one 'solve'") +
                             (dependence.ends_with_response
                                  ? ", or give this one 'stabilize: response' in an 'iterate' that solves for both"
                                  : ""));
}

/// The derivatives of another program's equations are unknown, so it is solved alone and its answer is taken.
void require_alone(const SolveOptions& options, const std::vector<Part*>& parts) {
  for (const auto* outside : parts_with<SolvedOutside>(parts)) {
    const std::string& name = outside->component();
    if (std::ranges::count(options.components, name) == 0) continue;
    if (options.components.size() > 1)
      throw InputError(options.origin, quoted(name) + " is solved together with other components",
                       "another program solves for it, and the derivatives of its answer are unknown",
                       "give it a 'solve' of its own, in an 'iterate' with the others");
    if (options.stabilization != "none")
      throw InputError(options.stabilization_origin, "the 'solve' of " + quoted(name) + " is stabilized",
                       "another program solves for it, and its equations are not known here",
                       "leave 'stabilize' out: the program may stabilize itself");
  }
}

/// The pairs of fields of a stabilization that are both solved for.
std::vector<Following> followers(const std::string& stabilization, const std::vector<Part*>& parts,
                                 const std::vector<Field*>& solved) {
  std::vector<Following> pairs;
  if (stabilization == "none") return pairs;
  if (stabilization == response) {
    std::vector<const Field*> on_interfaces;
    for (const Field* field : solved)
      if (!is_bulk(field->spec().role.kind()) && field->size() > 0) on_interfaces.push_back(field);
    for (const Field* row : on_interfaces)
      for (const Field* column : on_interfaces) pairs.push_back({row, column});
    return pairs;
  }
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
  constexpr int largest_in_space = 50'000;           // factors fill far more than in a plane: memory
  constexpr int largest_in_space_instead = 250'000;  // one factorization takes as long as some 400 iterations there
  if (dimension == 3) {
    options.largest_for_direct = largest_in_space;
    options.largest_for_direct_instead = largest_in_space_instead;
    options.condensing = {.columns = 700, .columns_at_once = 700, .width = 5, .power = 2.0 / 3};  // slipping discs
  }
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
              "for what is on fractures only. Direct solvers."});
  spec.check([&options](const Node& node) {
    if (options.type == "umfpack" && parallel::size() > 1)
      throw InputError(node.find("type")->origin,
                       "linear solver 'umfpack' cannot run on " + std::to_string(parallel::size()) + " processes",
                       "it knows one only", "use 'mumps', 'belos' or 'auto'");
  });
  return spec;
}

Spec SolveOptions::spec() {
  Spec spec("solve",
            "Solves for the unknowns of the named components simultaneously. All their terms count; "
            "fields that are not unknowns here keep their latest values.");
  spec.texts("solve", components, {.doc = "Names of components.", .required = true});
  spec.text("stabilize", stabilization,
            {.doc = "A stabilization of split schemes: response, the Schur complement of the unknowns of the iteration "
                    "that this step holds; "
                    "one that a coupler offers (its page names it); or none."});
  spec.section("newton", newton_spec(newton), {.doc = "Overrides the scene's `newton:`."}, &overrides_newton);
  spec.section("solver", solver_spec(linear), {.doc = "Overrides the scene's `solver:`."}, &overrides_linear);
  return spec;
}

SolveStep::SolveStep(const SolveOptions& options, const ScheduleContext& context)
    : options_(options),
      parts_(context.parts),
      fields_(context.solved_fields(options.components)),
      mesh_(context.mesh),
      store_(context.fields),
      log_(context.log),
      newton_(newton_for(fields_)) {
  require_offered(options, context.parts);
  require_together(options, context.parts);
  require_alone(options, context.parts);
}

std::unique_ptr<Newton> SolveStep::newton_for(const std::vector<Field*>& unknowns) const {
  return std::make_unique<Newton>(mesh_, unknowns, parts_, options_.linear, options_.newton, describe(), log_);
}

std::string SolveStep::describe() const {
  std::string text = "solve";
  for (const std::string& name : options_.components) text += " " + name;
  return text;
}

std::vector<const Field*> SolveStep::waiting() const {
  std::vector<const Field*> waiting;
  for (const Field* field : iterated_)
    if (std::ranges::count(fields_, field) == 0) waiting.push_back(field);
  return waiting;
}

std::vector<const Field*> SolveStep::answering() const {
  std::vector<const Field*> answering = waiting();
  const auto is_solved = [&](const std::string& component) {
    return std::ranges::any_of(fields_, [&](const Field* field) { return field->spec().owner == component; });
  };
  for (const Part* part : parts_)
    for (const Dependence& dependence : part->dependences())
      if (is_solved(dependence.on))
        std::erase_if(answering, [&](const Field* field) { return field->spec().owner == dependence.component; });
  return answering;
}

ResponseOptions SolveStep::wanted_responses() const {
  // Residuals of waiting unknowns may be enlarged many times in the equations of this solve.
  constexpr double settled = 0.1;
  const bool is_response = options_.stabilization == response;
  return {followers(options_.stabilization, parts_, fields_), !is_response, is_response && !options_.is_over_substeps,
          settled * options_.newton.residual};
}

std::vector<const Field*> SolveStep::held_amounts() const {
  std::vector<const Field*> held;
  if (options_.stabilization == "none" || options_.stabilization == response) return held;
  const std::vector<const Field*> waits = waiting();
  for (const Part* part : parts_)
    if (const auto* holds = dynamic_cast<const Stabilizes*>(part))
      for (const Field* field : holds->holds_amounts_of(options_.stabilization))
        if (std::ranges::count(waits, field) > 0 && std::ranges::count(held, field) == 0) held.push_back(field);
  return held;
}

const Responses& SolveStep::responses(const StepTime& step) {
  static const Responses none;
  if (!is_response_made_) {
    is_response_made_ = true;
    if (std::vector<const Field*> held = held_amounts(); !held.empty())
      amounts_ = std::make_unique<HeldAmounts>(mesh_, std::move(held), unknowns(), parts_);
    ResponseOptions wanted = wanted_responses();
    const std::vector<const Field*> answers = answering();
    if (!wanted.pairs.empty() && !answers.empty()) {
      response_ = std::make_unique<WaitingResponse>(mesh_, answers, parts_, std::move(wanted), options_.linear);
      std::vector<Field*> unknowns = fields_;
      for (const auto& copy : response_->copies(step)) unknowns.push_back(copy.get());
      if (unknowns.size() > fields_.size()) {
        newton_ = newton_for(unknowns);
        newton_->iterate_at_least_once();
      }
    }
  }
  if (amounts_) {
    of_amounts_.terms = amounts_->update(step);
    return of_amounts_;
  }
  return response_ ? response_->update(step) : none;
}

void SolveStep::check_response() const {
  const auto no_effect = [&](const std::string& because, const std::string& remedy) {
    return InputError(options_.stabilization_origin, "'stabilize: response' has no effect here", because, remedy);
  };
  if (wanted_responses().pairs.empty())
    throw no_effect("it is for unknowns on interfaces, of which this step solves for none",
                    "give it to a 'solve' that has some");
  if (waiting().empty())
    throw no_effect("this step solves for all unknowns of the iteration, so none waits", "remove it");
  if (answering().empty())
    throw no_effect(
        "'" + waiting().front()->spec().owner + "' waits alone, and has no answer while what it needs is held",
        "remove it, and give it to the 'solve' of '" + waiting().front()->spec().owner + "'");
  for (const Part* part : parts_)
    for (const Dependence& dependence : part->dependences()) {
      const auto is_of = [](const std::string& name) {
        return [name](const Field* field) { return field->spec().owner == name; };
      };
      if (std::ranges::any_of(fields_, is_of(dependence.component)) &&
          std::ranges::none_of(iterated_, is_of(dependence.on)))
        throw InputError(options_.origin, "'" + dependence.component + "' is solved without '" + dependence.on + "'",
                         dependence.because, "let the same 'iterate' solve for both");
    }
}

void SolveStep::check_solver() const {
  if (options_.linear.type != "belos") return;
  for (const Part* part : parts_) {
    const auto* needing = dynamic_cast<const NeedsDirectSolver*>(part);
    if (!needing) continue;
    const NeedsDirectSolver::Need need = needing->needs_direct_solver();
    if (need.field && std::ranges::count(fields_, need.field) > 0)
      throw InputError(options_.origin, "'solver: belos' cannot solve for " + need.field->name(), need.because,
                       "choose 'auto', 'umfpack' or 'mumps'");
  }
}

void SolveStep::check() const {
  check_solver();
  if (options_.stabilization == "none") return;
  if (options_.stabilization == response) return check_response();
  Stabilization stabilization;
  for (const auto* part : parts_with<Stabilizes>(parts_)) part->stabilize(options_.stabilization, stabilization);
  const auto is_solved = [&](const auto& entry) { return std::ranges::count(fields_, entry.first) > 0; };
  for (const Part* part : parts_)
    if (const auto* holds = dynamic_cast<const Stabilizes*>(part))
      for (const Field* field : holds->holds_amounts_of(options_.stabilization)) {
        const std::string& owner = field->spec().owner;
        if (std::ranges::count(waiting(), field) == 0)
          throw InputError(options_.stabilization_origin,
                           "'stabilize: " + options_.stabilization + "' has no effect here",
                           "it takes the amounts that " + field->name() +
                               " stores to stay while it waits, and this step solves for it, or nobody does",
                           "give it to a 'solve' without '" + owner + "', in an 'iterate' that solves for both");
      }
  if (stabilization.empty() || std::ranges::any_of(stabilization, is_solved)) return;
  if (!followers(options_.stabilization, parts_, fields_).empty()) return;
  throw InputError(options_.stabilization_origin, "'stabilize: " + options_.stabilization + "' has no effect here",
                   "it is for " + stabilization.begin()->first->name() + ", which this step does not solve for",
                   "give it to the 'solve' of '" + stabilization.begin()->first->spec().owner + "'");
}

StepStatus SolveStep::solve(const StepTime& step, const Stabilization& stabilization, const Responses& of_waiting) {
  const auto has_bound = [](const ResponseTerm& term) { return term.least.size() > 0; };
  if (std::ranges::none_of(of_waiting.terms, has_bound)) return newton_->solve(step, stabilization, of_waiting);
  std::vector<Vector> start;
  for (const Field* field : fields_) start.push_back(field->now());
  Responses unbounded = of_waiting;
  for (ResponseTerm& term : unbounded.terms) term.least = {};
  const StepStatus status = newton_->solve(step, stabilization, unbounded);
  if (status.converged) return status;
  for (std::size_t u = 0; u < fields_.size(); ++u) fields_[u]->set(start[u]);
  return newton_->solve(step, stabilization, of_waiting);
}

bool SolveStep::is_good_enough(const StepTime& step) {
  // Unless the scene has `newton:` options of its own: values of solves that have not converged may lead away.
  constexpr int most_in_a_row = 5;
  if (!options_.may_be_inexact || !newton_->has_used_up_iterations()) return false;
  const bool goes_on = step.start == inexact_in_.start && step.dt == inexact_in_.dt;
  inexact_ = goes_on ? inexact_ + 1 : 1;
  inexact_in_ = step;
  return options_.overrides_newton || inexact_ <= most_in_a_row;
}

void SolveStep::require_held(const StepTime& step) const {
  if (fields_.empty()) return;
  // A stabilization stands for unknowns that wait: what holds the balances may be among them.
  std::vector<const Field*> solved = unknowns();
  if (options_.stabilization != "none") std::ranges::copy(waiting(), std::back_inserter(solved));
  Assembly assembly(solved, Assembly::Request::residual_and_derivatives);
  assemble_all(assembly, parts_, step);
  const BlockSystem system(mesh_, solved);
  const bool rests = check_residual(assembly, system, options_.newton.residual).converged;
  const std::string floating = system.describe_floating(assembly, rests ? Floating::everywhere : Floating::somewhere);
  if (!floating.empty()) throw InputError(options_.origin, floating);
}

StepStatus SolveStep::run(const StepTime& step) {
  // A state that is settled before the first step has the length of that step, and ends at the start.
  SPREKK_EXPECT(step.dt > 0 && step.end >= step.start, step.start, step.dt, step.end);
  Stabilization stabilization, preconditioning;
  for (const auto* part : parts_with<Stabilizes>(parts_)) {
    part->stabilize_preconditioner(preconditioning);
    if (options_.stabilization != "none") part->stabilize(options_.stabilization, stabilization);
  }
  const Responses& of_waiting = responses(step);
  newton_->set_preconditioner_stabilization(preconditioning);
  StepStatus status = solve(step, stabilization, of_waiting);
  if (status.converged)
    inexact_ = 0;
  else
    status.converged = !status.lost_at && is_good_enough(step);
  if (!status.converged && response_ && !response_->is_determined())
    status.reason +=
        " (the unknowns that wait are not determined while those of this step are held, so they have no response)";
  if (!status.converged) return status;
  std::vector<Field*> solved = fields_;
  // What is solved for over other steps keeps its values, and its amounts over them.
  if (response_ && !options_.is_over_substeps)
    for (std::size_t k = 0; k < response_->copied().size(); ++k) {
      solved.push_back(&store_.at(response_->copied()[k]->name()));
      solved.back()->set(response_->copies(step)[k]->now());
    }
  for (Part* part : parts_) part->after_solve(solved, step);
  return status;
}

void SolveStep::add_counts(LinearCounts& counts) const {
  counts += newton_->counts();
  if (response_) counts += response_->counts();
}

}  // namespace sprekk
