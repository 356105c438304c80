// From the `schedule:` of a scene to its tree of steps.
#include <algorithm>

#include "framework/schedule/iterate_step.hpp"
#include "framework/schedule/schedule_context.hpp"
#include "framework/schedule/sequence_step.hpp"
#include "framework/schedule/solve_step.hpp"
#include "framework/schedule/subcycle_step.hpp"
#include "framework/schedule/when_step.hpp"

namespace sprekk {

std::vector<Field*> ScheduleContext::solved_fields(const std::vector<std::string>& components) const {
  std::vector<Field*> solved;
  for (const auto& field : fields.all())
    if (field->is_solved() &&
        std::find(components.begin(), components.end(), field->spec().owner) != components.end())
      solved.push_back(field.get());
  return solved;
}

namespace {

void check_components(const std::vector<std::string>& names, const Node& node, const ScheduleContext& context) {
  for (const std::string& name : names)
    if (std::find(context.component_names.begin(), context.component_names.end(), name) ==
        context.component_names.end())
      throw unknown_name(node.find("solve")->origin, "component", name, context.component_names);
}

std::unique_ptr<ScheduleStep> build_solve(const Node& node, const ScheduleContext& context) {
  SolveOptions options;
  options.newton = context.newton;
  options.linear = context.linear;
  options.spec().read(node, {});
  check_components(options.components, node, context);
  return std::make_unique<SolveStep>(options, context);
}

/// The options of a step that has steps inside, and these steps.
template <class Options>
std::unique_ptr<ScheduleStep> read_inside(const Node& node, const std::string& key, const std::string& inside_key,
                                          Options& options, const ScheduleContext& context) {
  const Node& whole = key == inside_key ? node : *node.find(key);
  Spec spec = options.spec();
  const Node* inside = nullptr;
  spec.custom(inside_key, [&](const Node& value) { inside = &value; },
              {.doc = "The steps inside.", .required = true});
  spec.read(whole, {});
  return build_schedule(*inside, context);
}

std::unique_ptr<ScheduleStep> build_iterate(const Node& node, const ScheduleContext& context) {
  IterateOptions options;
  auto inside = read_inside(node, "iterate", "steps", options, context);
  return std::make_unique<IterateStep>(options, std::move(inside), context);
}

std::unique_ptr<ScheduleStep> build_subcycle(const Node& node, const ScheduleContext& context) {
  SubcycleOptions options;
  auto inside = read_inside(node, "subcycle", "steps", options, context);
  return std::make_unique<SubcycleStep>(options, std::move(inside), context);
}

std::unique_ptr<ScheduleStep> build_when(const Node& node, const ScheduleContext& context) {
  WhenOptions options;
  Spec spec = options.spec();
  const Node* inside = nullptr;
  spec.custom("steps", [&](const Node& value) { inside = &value; }, {.doc = "The steps inside.", .required = true});
  spec.read(node, {});
  return std::make_unique<WhenStep>(options, build_schedule(*inside, context));
}

template <class Options>
Spec example_spec() {
  static Options options;
  return options.spec();
}

}  // namespace

const std::vector<ScheduleKind>& schedule_kinds() {
  static const std::vector<ScheduleKind> kinds = {{"solve", build_solve, example_spec<SolveOptions>},
                                                  {"iterate", build_iterate, example_spec<IterateOptions>},
                                                  {"subcycle", build_subcycle, example_spec<SubcycleOptions>},
                                                  {"when", build_when, example_spec<WhenOptions>}};
  return kinds;
}

std::unique_ptr<ScheduleStep> build_schedule(const Node& node, const ScheduleContext& context) {
  if (node.is_list()) {
    if (node.items.empty())
      throw InputError(node.origin, "the schedule is empty", "nothing would be solved",
                       "write a step, for example 'solve: [...]'");
    std::vector<std::unique_ptr<ScheduleStep>> steps;
    for (const Node& item : node.items) steps.push_back(build_schedule(item, context));
    if (steps.size() == 1) return std::move(steps.front());
    return std::make_unique<SequenceStep>(std::move(steps));
  }
  std::vector<std::string> keys;
  for (const ScheduleKind& kind : schedule_kinds()) {
    if (node.is_map() && node.find(kind.key)) return kind.build(node, context);
    keys.push_back(kind.key);
  }
  if (node.is_map() && !node.entries.empty())
    throw unknown_name(node.entries.front().origin, "step of the schedule", node.entries.front().key, keys);
  throw InputError(node.origin, "a step of the schedule is missing", "a step is a map such as 'solve: [pore, rock]'");
}

}  // namespace sprekk
