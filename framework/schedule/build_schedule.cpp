// Reads the `schedule:` of a scene into a function that builds its tree of steps.
#include <algorithm>

#include "framework/config/unknown_key.hpp"
#include "framework/plugin/plugin.hpp"
#include "framework/schedule/grow_step.hpp"
#include "framework/schedule/iterate_step.hpp"
#include "framework/schedule/jacobi_step.hpp"
#include "framework/schedule/schedule_context.hpp"
#include "framework/schedule/schedule_registry.hpp"
#include "framework/schedule/sequence_step.hpp"
#include "framework/schedule/solve_step.hpp"
#include "framework/schedule/subcycle_step.hpp"
#include "framework/schedule/when_step.hpp"

namespace sprekk {

std::vector<Field*> ScheduleContext::solved_fields(const std::vector<std::string>& components) const {
  std::vector<Field*> solved;
  for (const auto& field : fields.all())
    if (field->is_solved() && std::find(components.begin(), components.end(), field->spec().owner) != components.end())
      solved.push_back(field.get());
  return solved;
}

namespace {

void check_components(const std::vector<std::string>& names, const Node& node, const ScheduleReading& reading) {
  const Node& solve = *node.find("solve");
  if (names.empty())
    throw InputError(solve.origin, "the step solves for nothing", "it names no component", "write 'solve: [a, b]'");
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Origin& where = solve.is_list() ? solve.items[i].origin : solve.origin;
    const std::vector<std::string>& known = reading.component_names;
    if (std::find(known.begin(), known.end(), names[i]) == known.end())
      throw InputError(
          where, "unknown component " + quoted(names[i]), "it is not one of: " + listed(known),
          names[i] == "all" ? "name each of them: 'solve: [" + listed(known) + "]'" : name_advice(names[i], known, ""));
    if (std::find(names.begin(), names.begin() + static_cast<long>(i), names[i]) !=
        names.begin() + static_cast<long>(i))
      throw InputError(where, "component " + quoted(names[i]) + " stands twice in one 'solve'",
                       "a step solves for its unknowns once", "remove one of them");
  }
}

/// The step in the stages of the scheme, unless a step around it takes them.
ScheduleBuilder in_stages(const ScheduleBuilder& step, const ScheduleReading& reading) {
  if (reading.scheme == TimeScheme::backward_euler || reading.is_in_stages) return step;
  return [step, scheme = reading.scheme, waiting = reading.waiting](const ScheduleContext& context) {
    ScheduleContext inside = context;
    inside.pass = nullptr;
    return std::make_unique<SubcycleStep>(SubcycleOptions{1, waiting, true}, scheme, step(inside), context);
  };
}

ScheduleBuilder read_solve(const Node& node, const ScheduleReading& reading) {
  SolveOptions options;
  options.newton = reading.newton;
  options.linear = reading.linear;
  const Node* stabilize = node.find("stabilize");
  options.stabilization_origin = stabilize ? stabilize->origin : node.origin;
  options.origin = node.find("solve")->origin;
  options.may_be_inexact = reading.may_be_inexact;
  options.is_over_substeps = reading.is_over_substeps;
  options.spec().read(node, reading.read);
  check_components(options.components, node, reading);
  if (options.stabilization != "none" && !reading.is_iterated)
    throw InputError(options.stabilization_origin, "'stabilize' stands outside of an 'iterate'",
                     "it adds a term to the balance that only iterating removes", "put the steps into an 'iterate'");
  if (reading.is_iterated && options.newton.residual > reading.tightest_until)
    throw InputError(node.find("newton")->origin, "'newton: residual' is larger than 'until: relative'",
                     "the iteration would never see residuals that the solve inside leaves",
                     "lower it to a tenth of 'relative', or leave it out: then it is");
  return in_stages([options](const ScheduleContext& context) { return std::make_unique<SolveStep>(options, context); },
                   reading);
}

/// The spec of a step that has steps inside; `inside` receives them.
template <class Options>
Spec with_steps(Options& options, const Node*& inside) {
  Spec spec = options.spec();
  spec.custom("steps", [&inside](const Node& value) { inside = &value; },
              {.doc = "The steps inside: a list, as a schedule.", .required = true});
  return spec;
}

/// The spec of the whole step whose options stand below its key: {iterate: {steps: …}}.
Spec below_key(const std::string& key, Spec options) {
  Spec spec("a step '" + key + "'", options.doc());
  spec.section(key, std::move(options), {.required = true});
  return spec;
}

/// Reads a step with `spec`, and the steps inside, which it finds; `adapt` may change the context for them.
ScheduleBuilder read_inside(const Node& node, const Spec& spec, const Node* const& inside, ScheduleReading reading,
                            const std::function<void(ScheduleReading&)>& adapt = {}) {
  spec.read(node, reading.read);
  if (adapt) adapt(reading);
  return read_schedule(*inside, reading);
}

/// Whether a `subcycle` of several substeps is among the steps.
bool has_substeps(const Node& steps) {
  const Node* cycle = steps.find("subcycle");
  const Node* count = cycle ? cycle->find("count") : nullptr;
  if (count && count->scalar != "1") return true;
  return std::ranges::any_of(steps.items, has_substeps) ||
         std::ranges::any_of(steps.entries, [](const Node::Entry& entry) { return has_substeps(entry.value); });
}

ScheduleBuilder read_iterate(const Node& node, const ScheduleReading& reading) {
  IterateOptions options;
  const Node* found = nullptr;
  const Spec spec = below_key("iterate", with_steps(options, found));
  const ScheduleBuilder inside = read_inside(node, spec, found, reading, [&](ScheduleReading& inner) {
    options.newton = inner.newton;
    options.linear = inner.linear;
    inner.is_iterated = true;
    inner.tightest_until = std::min(inner.tightest_until, options.until.tightest());
    // Steps inside of an iteration must be solved more accurately than the iteration asks for, or it would stall.
    constexpr double tighter = 0.1;
    inner.newton.residual = std::min(inner.newton.residual, tighter * options.until.tightest());
    options.newton.residual = inner.newton.residual;
    options.has_substeps = has_substeps(*found);
    inner.is_in_stages = reading.is_in_stages || !options.has_substeps;
    inner.may_be_inexact = !options.has_substeps && options.until.bounds_residual();
    inner.is_over_substeps = options.has_substeps;
  });
  const Node& steps = *found;
  if (options.has_substeps) options.until.require_changes();
  if (const Node* fallback = node.find("iterate")->find("fallback");
      fallback && options.has_substeps && options.fallback != "none")
    throw InputError(fallback->origin, "'fallback: " + options.fallback + "' has no effect",
                     "the steps inside take substeps, which no system of the whole step replaces", "remove it");
  if (options.order == "jacobi" && (!steps.is_list() || steps.items.size() < 2))
    throw InputError(node.find("iterate")->find("order")->origin, "'order: jacobi' has no effect",
                     "there is one step inside", "remove it, or split the step");
  const ScheduleBuilder iterate = [options, inside](const ScheduleContext& context) -> std::unique_ptr<ScheduleStep> {
    const auto pass = std::make_shared<int>(0);
    ScheduleContext numbered = context;
    numbered.pass = pass;
    if (context.log)
      numbered.log = [log = context.log, pass](const IterationRecord& record) {
        IterationRecord in_pass = record;
        if (in_pass.pass == 0) in_pass.pass = *pass;
        log(in_pass);
      };
    std::unique_ptr<ScheduleStep> steps = inside(numbered);
    if (auto* sequence = dynamic_cast<SequenceStep*>(steps.get()); sequence && options.order == "jacobi")
      steps = std::make_unique<JacobiStep>(sequence->take_steps(), context.fields);
    return std::make_unique<IterateStep>(options, std::move(steps), context, pass);
  };
  return options.has_substeps ? iterate : in_stages(iterate, reading);
}

ScheduleBuilder read_subcycle(const Node& node, const ScheduleReading& reading) {
  SubcycleOptions options;
  bool takes_stages = false;
  const Node* found = nullptr;
  const Spec spec = below_key("subcycle", with_steps(options, found));
  const ScheduleBuilder inside = read_inside(node, spec, found, reading, [&](ScheduleReading& inner) {
    takes_stages = !reading.is_in_stages && !has_substeps(*found);
    inner.is_substep = inner.is_substep || options.count > 1;
    inner.may_be_inexact = inner.may_be_inexact && options.count == 1;
    inner.is_in_stages = reading.is_in_stages || takes_stages;
    inner.waiting = options.waiting;
  });
  if (reading.is_iterated && reading.is_substep && options.count > 1)
    throw InputError(node.find("subcycle")->origin, "a 'subcycle' stands inside of another one, in an 'iterate'",
                     "passes compare substeps with those of the pass before, one level of them",
                     "multiply the counts of both");
  const Node* waiting = node.find("subcycle")->find("waiting");
  if (reading.is_iterated && reading.scheme == TimeScheme::sdirk2 && options.count > 1 && options.waiting == "held")
    throw InputError(waiting ? waiting->origin : node.find("subcycle")->origin,
                     "substeps are of first order in time where what waits is held",
                     "'time: scheme: sdirk2' is of second order", "write 'waiting: linear', or leave 'scheme' out");
  const TimeScheme scheme = takes_stages ? reading.scheme : TimeScheme::backward_euler;
  return [options, inside, scheme](const ScheduleContext& context) {
    ScheduleContext alone = context;
    alone.pass = nullptr;
    return std::make_unique<SubcycleStep>(options, scheme, inside(alone), context);
  };
}

ScheduleBuilder read_when(const Node& node, const ScheduleReading& reading) {
  if (reading.is_iterated)
    throw InputError(node.find("when")->origin, "'when' stands inside of an 'iterate'",
                     "the iteration tests the residual of everything inside, also of what is not run",
                     "put the 'iterate' inside of the 'when'");
  WhenOptions options;
  const Node* found = nullptr;
  const ScheduleBuilder inside = read_inside(node, with_steps(options, found), found, reading);
  return [options, inside](const ScheduleContext& context) {
    return std::make_unique<WhenStep>(options, inside(context));
  };
}

ScheduleBuilder read_grow(const Node& node, const ScheduleReading& reading) {
  if (reading.is_iterated || reading.is_substep)
    throw InputError(node.find("grow")->origin, "'grow' stands inside of an 'iterate' or a 'subcycle'",
                     "the mesh changes with whole time steps only", "put it behind them");
  GrowOptions options;
  options.newton = reading.newton;
  options.linear = reading.linear;
  options.origin = node.find("grow")->origin;
  options.is_followed = reading.is_followed;
  options.spec().read(node, reading.read);
  const std::vector<std::string>& known = reading.component_names;
  std::vector<std::string> named = options.settle;
  named.push_back(options.component);
  for (const std::string& name : named)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw unknown_name(options.origin, "component", name, known);
  return [options](const ScheduleContext& context) {
    auto step = std::make_unique<GrowStep>(options, context);
    if (!context.growing) return step;
    for (const GrowStep* other : *context.growing)
      if (other->options().component == options.component && other->grows_within_step() != step->grows_within_step())
        throw InputError(options.origin, "'grow: " + options.component + "' is there with and without 'within_step'",
                         "growth is found in one way for the whole run", "give both the same 'update'");
    context.growing->push_back(step.get());
    return step;
  };
}

template <class Options>
Spec example_spec() {
  static Options options;
  return options.spec();
}

template <class Options>
Spec example_with_steps() {
  static Options options;
  static const Node* inside;
  return with_steps(options, inside);
}

std::vector<ScheduleKind>& kinds() {
  static std::vector<ScheduleKind> kinds = {{"solve", read_solve, example_spec<SolveOptions>},
                                            {"iterate", read_iterate, example_with_steps<IterateOptions>},
                                            {"subcycle", read_subcycle, example_with_steps<SubcycleOptions>},
                                            {"when", read_when, example_with_steps<WhenOptions>},
                                            {"grow", read_grow, example_spec<GrowOptions>}};
  return kinds;
}

}  // namespace

const std::vector<ScheduleKind>& schedule_kinds() { return kinds(); }

RegisterScheduleStep::RegisterScheduleStep(const ScheduleKind& kind) {
  for (const ScheduleKind& known : kinds())
    if (known.key == kind.key) {
      refuse_registration(kind.key);
      return;
    }
  note_registration(kind.key);
  kinds().push_back(kind);
}

namespace {

/// The value `within_step` of a `grow` in these steps, or nullptr.
const Node* growth_within_step(const Node& steps) {
  const Node* update = steps.find("grow") ? steps.find("update") : nullptr;
  if (update && update->scalar == within_step) return update;
  for (const Node& item : steps.items)
    if (const Node* found = growth_within_step(item)) return found;
  for (const Node::Entry& entry : steps.entries)
    if (const Node* found = growth_within_step(entry.value)) return found;
  return nullptr;
}

/// The step behind another one that changes the state at the end of the time step, or nullptr. Several `when` are
/// allowed: the scene has to see that only one of them holds at a time.
const char* what_follows(const std::vector<Node>& steps, std::size_t step) {
  for (std::size_t k = step + 1; k < steps.size(); ++k)
    for (const char* key : {"solve", "grow"})
      if (has_step(steps[k], key) && !(steps[step].find("when") && steps[k].find("when"))) return key;
  return nullptr;
}

/// Growth within a step belongs to the state at its end: nothing may change this state afterwards.
void require_growth_last(const std::vector<Node>& steps) {
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Node* growth = growth_within_step(steps[i]);
    const char* key = growth ? what_follows(steps, i) : nullptr;
    if (key)
      throw InputError(growth->origin, std::string("a '") + key + "' stands behind growth within steps",
                       "the advance of the tips belongs to the state at the end of the step", "put 'grow' last");
  }
}

/// Growth follows from the state at the end of a step, which must have been solved.
void require_growth_behind_solve(const std::vector<Node>& steps) {
  bool is_solved = false;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    is_solved = is_solved || has_step(steps[i], "solve");
    if (is_solved || !steps[i].find("grow")) continue;
    for (std::size_t k = i + 1; k < steps.size(); ++k)
      if (has_step(steps[k], "solve"))
        throw InputError(steps[i].find("grow")->origin, "'grow' stands in front of the 'solve'",
                         "growth would follow from the state before the step, as its loads are not in it yet",
                         "put 'grow' behind the 'solve'");
  }
}

}  // namespace

ScheduleBuilder read_schedule(const Node& node, const ScheduleReading& reading) {
  if (node.is_list()) {
    if (node.items.empty())
      throw InputError(node.origin, "the schedule is empty", "nothing would be solved",
                       "write a step, for example 'solve: [...]'");
    std::vector<ScheduleBuilder> steps;
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      ScheduleReading of_item = reading;
      of_item.is_followed = reading.is_followed || what_follows(node.items, i);
      steps.push_back(read_schedule(node.items[i], of_item));
    }
    require_growth_last(node.items);
    require_growth_behind_solve(node.items);
    if (steps.size() == 1) return steps.front();
    return [steps](const ScheduleContext& context) {
      std::vector<std::unique_ptr<ScheduleStep>> built;
      for (const ScheduleBuilder& step : steps) built.push_back(step(context));
      return std::make_unique<SequenceStep>(std::move(built));
    };
  }
  std::vector<std::string> keys;
  const ScheduleKind* found = nullptr;
  for (const ScheduleKind& kind : schedule_kinds()) {
    keys.push_back(kind.key);
    if (!node.is_map() || !node.find(kind.key)) continue;
    if (found)
      throw InputError(node.origin, "one step is '" + found->key + "' and '" + kind.key + "' at once",
                       "each step is an item of the list", "put a '-' before each of the two");
    found = &kind;
  }
  if (found) return found->read(node, reading);
  if (node.is_map() && !node.entries.empty())
    throw unknown_key(node.entries.front().origin, "step of the schedule", node.entries.front().key, keys);
  throw InputError(node.origin, "a step of the schedule is missing", "a step is a map such as 'solve: [pore, rock]'");
}

bool has_step(const Node& schedule, const std::string& key) {
  return std::any_of(schedule.items.begin(), schedule.items.end(),
                     [&](const Node& item) { return has_step(item, key); }) ||
         std::any_of(schedule.entries.begin(), schedule.entries.end(),
                     [&](const Node::Entry& entry) { return entry.key == key || has_step(entry.value, key); });
}

}  // namespace sprekk
