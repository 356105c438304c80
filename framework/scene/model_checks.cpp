// What is wrong with a scene, and shows only when its parts exist.
#include "framework/scene/model.hpp"

#include <algorithm>

#include "framework/assembly/heeds_stages.hpp"
#include "framework/assembly/lives_in_part.hpp"
#include "framework/assembly/state_fields.hpp"
#include "framework/output/vtu_writer.hpp"
#include "framework/schedule/subcycle_step.hpp"

namespace sprekk {

namespace {

/// Whether some, and not all, of so many unknowns take substeps.
bool has_other_clocks(const ScheduleStep& step, std::size_t unknowns) {
  const auto* substeps = dynamic_cast<const SubcycleStep*>(&step);
  if (substeps && substeps->has_own_clock() && substeps->unknowns().size() < unknowns) return true;
  return std::ranges::any_of(step.children(),
                             [&](const ScheduleStep* inside) { return has_other_clocks(*inside, unknowns); });
}

}  // namespace

void Model::check_outputs() const {
  std::vector<FrameOutputChoice> outputs = scene_.output.chosen_outputs();
  std::erase_if(outputs,
                [](const FrameOutputChoice& output) { return !output.check || output.has_nothing_to_check(); });
  if (outputs.empty()) return;
  const std::vector<OutputField> fields = output();
  const Frame start{scene_.time.start, 0, mesh_, fields, {}};
  for (const FrameOutputChoice& output : outputs) output.check(start);
}

void Model::check_determined() const {
  const std::vector<const Field*> solved = schedule_->unknowns();
  for (const auto& field : fields_.all()) {
    const FieldSpec& spec = field->spec();
    const auto entry = std::find_if(scene_.components.begin(), scene_.components.end(),
                                    [&](const Scene::ComponentEntry& c) { return c.name == spec.owner; });
    const Origin origin = entry != scene_.components.end() ? entry->origin : scene_.whole.origin;
    if (spec.role.is_input() && !spec.needs_coupler.empty() && field->determined_by().empty())
      throw InputError(origin, "nobody determines " + field->name(),
                       "component '" + spec.owner + "' needs a coupler of type '" + spec.needs_coupler + "'",
                       "add '- {type: " + spec.needs_coupler + ", between: [" + spec.owner + ", …]}' to 'couplers:'");
    if (field->is_solved() && field->size() > 0 && std::find(solved.begin(), solved.end(), field.get()) == solved.end())
      throw InputError(scene_.schedule_origin(), "no step solves for " + field->name(),
                       "the schedule does not name component '" + spec.owner + "'", "add it to a 'solve'");
  }
  for (const Part* part : parts_)
    if (const auto* formulas = dynamic_cast<const TakesState*>(part)) formulas->require_state();
}

void Model::check_stages() const {
  if (scene_.time.scheme == TimeScheme::backward_euler) return;
  const auto refuse = [&](const std::string& part) {
    throw InputError(scene_.time.scheme_origin, part + " is of first order in time",
                     "it takes time steps of one stage only", "leave 'scheme' out, or the part");
  };
  for (const auto& component : components_)
    if (!component->allows_stages()) refuse("component '" + component->name() + "'");
  for (const auto& coupler : couplers_)
    if (!coupler->allows_stages()) refuse("coupler '" + coupler->name() + "'");
  for (const auto* heeding : parts_with<HeedsStages>(parts_))
    if (const std::string why = heeding->need_of_one_clock();
        !why.empty() && has_other_clocks(*schedule_, schedule_->unknowns().size()))
      throw InputError(scene_.time.scheme_origin, "two stages in steps of several lengths", why,
                       "leave 'scheme' out, or put all into one 'subcycle'");
}

void Model::check_data() {
  const TimeOptions& time = scene_.time;
  const double step = std::min(time.step, time.end - time.start);
  std::vector<StepTime> steps = {{time.end - step, step, time.end}};
  for (const double jump : switch_times()) {
    if (jump <= time.start || jump >= time.end) continue;
    const double end = std::min(jump + step, time.end);
    steps.push_back({jump, end - jump, end});
  }
  // The first step comes last, so that parts keep the data of the first step.
  steps.push_back({time.start, step, time.start + step});
  for (const StepTime& at : steps)
    for (Part* part : parts_) part->evaluate_data(at);
}

}  // namespace sprekk
