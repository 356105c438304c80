// The state from which a run starts: settled, or as it is given.
#include "framework/scene/model.hpp"

#include <algorithm>
#include <iterator>

#include "framework/assembly/counts_from_here.hpp"
#include "framework/assembly/keeps_totals.hpp"
#include "framework/assembly/notes_start.hpp"
#include "framework/assembly/rests_together.hpp"
#include "framework/output/activity.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/schedule/schedule_context.hpp"

namespace sprekk {

namespace {

/// Turns the status into "not converged" where a value grows with the time, however small the rate: then there is no
/// state at rest.
void refuse_growth(const std::vector<const Field*>& settled, StepStatus& status) {
  // In the unit of the field, or of its largest value before: far above any pressure or temperature.
  constexpr double without_end = 1e12;
  for (const Field* field : settled) {
    if (field->size() == 0) continue;
    const double before = parallel::max(field->accepted().lpNorm<Eigen::Infinity>());
    if (parallel::max(field->now().lpNorm<Eigen::Infinity>()) <= without_end * std::max(1.0, before)) continue;
    status.converged = false;
    status.reason = field->name() + " grows without end: what is brought in has no way out";
    return;
  }
}

}  // namespace

void Model::build_settling(const ScheduleContext& context) {
  const StartOptions& start = scene_.start;
  if (start.settle.empty()) return;
  if (!growing_.empty())
    throw InputError(start.origin, "the state at the start is not settled in a scene whose fractures grow",
                     "a mesh that has changed does not know the state from which changes are counted",
                     "remove 'settle', or the 'grow' step");
  const auto is_settled = [&](const std::string& name) { return std::ranges::count(start.settle, name) > 0; };
  for (const std::string& name : start.settle) {
    if (const auto* part = dynamic_cast<const CountsFromHere*>(context.named.at(name))) part->require_countable();
    if (context.solved_fields({name}).empty())
      throw InputError(start.origin, "'" + name + "' cannot be settled", "it has no unknowns",
                       "remove it from 'settle'");
  }
  for (const Part* part : parts_) {
    std::vector<Dependence> needs = part->dependences();
    if (const auto* rests = dynamic_cast<const RestsTogether*>(part))
      std::ranges::copy(rests->dependences_at_rest(), std::back_inserter(needs));
    for (const Dependence& dependence : needs)
      if (is_settled(dependence.component) && !is_settled(dependence.on))
        throw InputError(start.origin, "'" + dependence.component + "' is settled without '" + dependence.on + "'",
                         dependence.because, "name both in 'settle'");
  }
  SolveOptions options;
  options.components = start.settle;
  options.origin = start.origin;
  options.newton = scene_.newton;
  options.linear = scene_.linear;
  ScheduleContext quiet = context;
  quiet.log = {};  // coupling.csv has the iterations of time steps
  settle_ = std::make_unique<SolveStep>(options, quiet);
}

StepStatus Model::settle_start() {
  if (!settle_) return {true, "", 0};
  now_doing("settling the state at the start");
  // What depends on the length of steps is that of the first one: the state rests in the equations of the run.
  const StepTime first{scene_.time.start, scene_.time.step, scene_.time.start};
  begin_step(parts_, first);
  constexpr double forever = 1e30;  // s: rock conducts over L^2 S mu/k < 1e22 s
  StepStatus status = settle_->run({first.start, forever, first.end});
  if (status.converged) refuse_growth(settle_->unknowns(), status);
  if (!status.converged) return status;
  for (Part* part : parts_)
    if (auto* totals = dynamic_cast<KeepsTotals*>(part)) totals->begin_totals();
  count_from_here({settle_->unknowns()});
  accept();
  return status;
}

void Model::note_start() {
  if (scene_.start.from) return;
  for (const auto& component : components_) {
    const auto* notes = dynamic_cast<const NotesStart*>(component.get());
    if (notes && std::ranges::count(scene_.start.settle, component->name()) == 0) notes->note_start(scene_.notes);
  }
}

void Model::count_from_here(const SettledFields& settled) {
  for (Part* part : parts_)
    if (auto* counts = dynamic_cast<CountsFromHere*>(part)) counts->count_from_here(settled);
  for (Part* part : parts_)
    if (auto* amounts = dynamic_cast<CountsAmounts*>(part)) amounts->count_amounts_from_here(settled);
}

}  // namespace sprekk
