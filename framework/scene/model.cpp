#include "framework/scene/model.hpp"

#include "framework/round_off.hpp"
#include "framework/scene/unusual_values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "framework/assembly/assemble_all.hpp"
#include "framework/assembly/lives_in_part.hpp"
#include "framework/assembly/may_store_nothing.hpp"
#include "framework/field/ownership.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/expect_sound_mesh.hpp"
#include "framework/mesh/partition.hpp"
#include "framework/mesh/search/point_location.hpp"
#include "framework/meshing/generate_mesh.hpp"
#include "framework/output/activity.hpp"
#include "framework/output/vtu_writer.hpp"
#include "framework/outside/solved_outside.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/scene/lost_amounts.hpp"
#include "framework/scene/probe_checks.hpp"
#include "framework/scene/programs.hpp"
#include "framework/schedule/gaps.hpp"
#include "framework/schedule/limits_step.hpp"
#include "framework/schedule/schedule_context.hpp"

namespace sprekk {

namespace {

Mesh make_mesh(const Scene& scene) {
  now_doing("the mesh");
  Mesh mesh = generate_mesh(scene.geometry, scene.mesh);

  partition(mesh, parallel::size(), scene.mesh.division);

  return mesh;
}

/// Data without a value at the start of the run are an error of the input.
template <class Build>
auto refusing_bad_data(const Build& build) {
  try {
    return build();
  } catch (const DataError& error) {
    throw InputError(error.what());
  }
}

}  // namespace

Model::Model(const Scene& scene, IterationLog log) : Model(scene, make_mesh(scene), std::move(log)) { note_start(); }

Model::Model(const Scene& scene, Mesh mesh, IterationLog log) : scene_(scene), mesh_(std::move(mesh)) {
  expect_sound(mesh_);
  SPREKK_EXPECT(are_indices(mesh_.cell_rank, parallel::size()), parallel::size());
  for (const Scene::ComponentEntry& entry : scene_.components) {
    now_doing("component " + entry.name);
    components_.push_back(refusing_bad_data([&] {
      return entry.build({entry.name, mesh_, fields_, scene_.time.start, entry.origin});
    }));
    parts_.push_back(components_.back().get());
  }
  std::vector<Component*> all;
  for (const auto& component : components_) all.push_back(component.get());
  for (const Scene::CouplerEntry& entry : scene_.couplers) {
    std::vector<Component*> between;
    for (const std::string& name : entry.between)
      for (Component* component : all)
        if (component->name() == name) between.push_back(component);
    now_doing("coupler " + entry.name);
    const CouplerContext context(entry.name, mesh_, fields_, between, all, scene_.time.start, entry.origin);
    couplers_.push_back(refusing_bad_data([&] { return entry.build(context); }));
    context.check_all_used();
    parts_.push_back(couplers_.back().get());
  }
  states_ = parts_with<KeepsState>(parts_);
  std::map<std::string, Part*> named;
  for (const auto& component : components_) named[component->name()] = component.get();
  const ScheduleContext context{mesh_,     fields_, parts_, std::move(log), named, scene_.time.start, scene_.time.step,
                                &growing_, &states_};
  schedule_ = scene_.schedule(context);
  require_programs_can_join(parts_, !growing_.empty(), scene_.start);
  build_settling(context);
  now_doing("the first evaluation of all data");
  check_determined();
  refusing_bad_data([this] {
    check_data();
    count_from_here({});  // the initial values
  });
  schedule_->check();
  check_stages();
  const bool has_output_probes =
      std::ranges::any_of(scene_.output.probes, [&](const auto& probe) { return !fields_.has(probe.second.of); });
  const std::vector<OutputField> outputs = has_output_probes ? derived_output() : std::vector<OutputField>();
  for (const auto& [name, options] : scene_.output.probes)
    probes_.emplace_back(name, options, mesh_, fields_, outputs, cells_with_values(options, components_));
  require_values_at_probes(scene_.output, components_, mesh_);
  std::vector<Quantity> others;
  refusing_bad_data([&] {
    for (const Part* part : parts_) part->report(others);
  });
  for (const auto& [name, balance] : balances())
    for (const char* what : {"_stored", "_injected", "_outflow", "_balance_error"})
      others.push_back({name + what, balance.unit, 0});
  require_own_columns(scene_.output, probes_, outputs, others);
  check_outputs();
}

namespace {

/// Values on which decisions of a run depend must be the same on all processes. With values that are right only on the
/// owner of an entity, processes would take different steps, and give a wrong answer or hang.
void require_agreement(const std::string& what, const std::vector<double>& values) {
  if (!parallel::is_same_everywhere(values))
    throw std::logic_error("processes differ in " + what +
                           " (a value that is right on the process of its owner only was used by all)");
}

}  // namespace

void Model::prepare(const StepTime& step) {
  SPREKK_EXPECT(step.dt > 0 && step.end > step.start, step.start, step.dt, step.end);
  for (Part* part : parts_) part->evaluate_data(step);
  for (const auto& component : components_) {
    now_doing("discretizing " + component->name());
    component->begin_step(step);
  }
  for (const auto& coupler : couplers_) {
    now_doing("preparing " + coupler->name());
    coupler->begin_step(step);
  }
}

void Model::require_held() {
  const bool may_float = std::ranges::any_of(parts_, [](const Part* part) {
    const auto* storing = dynamic_cast<const MayStoreNothing*>(part);
    return storing && storing->stores_nothing_somewhere();
  });
  if (!may_float) return;
  const TimeOptions& time = scene_.time;
  const double length = std::min(time.step, time.end - time.start);
  const StepTime first{time.start, length, time.start + length};
  refusing_bad_data([&] { prepare(first); });
  now_doing("looking for what nothing holds");
  // The state from which the first step starts is not known before it has settled.
  refusing_bad_data([&] { (settle_ ? *settle_ : *schedule_).require_held(first); });
}

namespace {

/// What the equations of all unknowns say of a quantity at the end of a step. Collective.
StepAmounts amounts_of(const std::string& quantity, const Mesh& mesh, const std::vector<const Field*>& unknowns,
                       const std::vector<Part*>& parts, const StepTime& step, bool lets_out) {
  Assembly assembly(unknowns, Assembly::Request::residual);
  assemble_all(assembly, parts, step);
  StepAmounts amounts;
  for (const Balances::Quantity& balanced : assembly.balances().quantities()) {
    if (balanced.name != quantity) continue;
    for (const int u : balanced.unknowns) {
      const Field& field = *unknowns[u];
      for (int i = 0; i < field.size(); ++i)
        if (is_owned(mesh, field.spec().location, i)) amounts.moved += assembly.balances().throughput(u)[i];
      // What leaves all rows is a difference of numbers as large as what rows exchange.
      amounts.round_off += rounding::of_sum * std::max(parallel::max(assembly.balances().round_off_base(u)),
                                                       lets_out ? parallel::max(assembly.round_off_base(u)) : 0.0);
    }
  }
  amounts.moved = parallel::sum(amounts.moved);
  return amounts;
}

}  // namespace

StepStatus Model::attempt(const StepTime& step) {
  for (auto* outside : parts_with<SolvedOutside>(parts_)) outside->join_run(parts_);
  const std::map<std::string, Balance> before = balances();
  prepare(step);
  now_doing("assembling and ordering");
  StepStatus status = schedule_->run(step);
  if (status.converged) refuse_losses(before, step, status);
  if (status.converged) refuse_too_long(step, status);
  require_agreement("how a step ended",
                    {step.start, step.dt, status.converged ? 1.0 : 0.0, status.retry_dt, double(status.iterations)});
  return status;
}

void Model::refuse_losses(const std::map<std::string, Balance>& before, const StepTime& step,
                          StepStatus& status) const {
  const double tolerance = schedule_->largest_imbalance();
  if (std::isinf(tolerance)) return;
  const std::map<std::string, Balance> after = balances();
  const std::string lost = find_lost_amounts(before, after, tolerance, [&](const std::string& quantity) {
    StepAmounts amounts =
        amounts_of(quantity, mesh_, schedule_->unknowns(), parts_, step, after.at(quantity).outflow != 0);
    amounts.round_off *= schedule_->summed_errors();
    return amounts;
  });
  if (lost.empty()) return;
  status.converged = false;
  status.reason = lost;
}

void Model::refuse_too_long(const StepTime& step, StepStatus& status) const {
  for (const Part* part : parts_) {
    const auto* limiting = dynamic_cast<const LimitsStep*>(part);
    const std::optional<StepTooLong> refusal = limiting ? limiting->too_long(step) : std::nullopt;
    if (!refusal || (!status.converged && refusal->retry_dt >= status.retry_dt)) continue;
    SPREKK_ASSERT(refusal->retry_dt > 0 && refusal->retry_dt < step.dt, refusal->retry_dt, step.dt);
    status.converged = false;
    status.retry_dt = refusal->retry_dt;
    status.reason = refusal->why;
  }
}

void Model::accept() {
  fields_.accept();
  for (KeepsState* state : states_) state->accepted();
}

void Model::rewind() {
  fields_.rewind();
  for (KeepsState* state : states_) state->rewound();
}

std::map<std::string, Vector> Model::extra_state() const {
  std::map<std::string, Vector> state;
  for (const KeepsState* keeper : states_) keeper->save(state);
  return state;
}

void Model::restore_extra_state(const std::map<std::string, Vector>& state) {
  for (KeepsState* keeper : states_) keeper->restore(state);
}

std::vector<double> Model::switch_times() const {
  std::vector<double> times;
  for (const Part* part : parts_) {
    const std::vector<double> more = part->switch_times();
    times.insert(times.end(), more.begin(), more.end());
  }
  return times;
}

std::map<std::string, Balance> Model::balances() const {
  std::map<std::string, Balance> balances;
  for (const Part* part : parts_) part->balance(balances);
  return balances;
}

std::vector<Quantity> Model::quantities() const {
  std::vector<Quantity> quantities;
  const bool has_output_probes = std::ranges::any_of(probes_, &Probe::is_of_output);
  const std::vector<OutputField> outputs = has_output_probes ? derived_output() : std::vector<OutputField>();
  for (const Probe& probe : probes_) probe.measure(quantities, outputs);
  for (const Part* part : parts_) part->report(quantities);
  for (const auto& [name, balance] : balances()) {
    quantities.push_back({name + "_stored", balance.unit, balance.stored});
    quantities.push_back({name + "_injected", balance.unit, balance.injected});
    quantities.push_back({name + "_outflow", balance.unit, balance.outflow});
    if (!balance.is_closed) continue;
    quantities.push_back({name + "_balance_error", balance.unit, balance.stored + balance.outflow - balance.injected});
  }
  std::vector<double> values;
  for (const Quantity& quantity : quantities) values.push_back(quantity.value);
  // One message for all; where they differ, the message names the first.
  if (!parallel::is_same_everywhere(values))
    for (const Quantity& quantity : quantities) require_agreement(quantity.name, {quantity.value});
  return quantities;
}

Notes Model::input_notes() const {
  Notes notes = scene_.notes;
  notes.of_input(scene_.time.start);
  note_unusual_values(properties_of(scene_, {mesh_, fields_, components_}), notes);
  for (const Part* part : parts_) part->note_input(notes);
  for (const auto& component : components_)
    if (const auto* growing = dynamic_cast<const Growing*>(component.get());
        growing && std::ranges::none_of(growing_, [&](const GrowStep* step) { return &step->component() == growing; }))
      notes.add(component->name() + " in no step",
                "no step looks at the fractures of " + component->name() +
                    ": it has no answer (a component whose fractures can grow is evaluated by a 'grow' step) add "
                    "'- grow: " +
                    component->name() + "' to 'schedule:'");
  note_gaps(*schedule_, fields_, scene_.time, notes);
  for (const CouplerType& type : Registry::instance().couplers()) {
    if (!type.note_absence) continue;
    std::vector<Component*> not_coupled;
    for (const auto& component : components_)
      if (std::ranges::none_of(scene_.couplers, [&](const Scene::CouplerEntry& entry) {
            return entry.type == type.type && std::ranges::count(entry.between, component->name()) > 0;
          }))
        not_coupled.push_back(component.get());
    type.note_absence(not_coupled, notes);
  }
  return notes;
}

std::vector<PendingPath> Model::pending_paths() const {
  std::vector<PendingPath> paths;
  for (const GrowStep* grow : growing_) {
    const std::vector<PendingPath> more = grow->component().pending_paths();
    paths.insert(paths.end(), more.begin(), more.end());
  }
  return paths;
}

std::vector<OutputField> Model::output() const {
  std::vector<OutputField> fields;
  for (const auto& field : fields_.all())
    if (!field->spec().role.is_derived() && field->size() > 0) fields.push_back(output_field(*field));
  for (OutputField& field : derived_output()) fields.push_back(std::move(field));
  hide_uninhabited(fields);
  return fields;
}

void Model::hide_uninhabited(std::vector<OutputField>& fields) const {
  for (const auto& component : components_) {
    const auto* partial = dynamic_cast<const LivesInPart*>(component.get());
    if (!partial || partial->inhabited_cells().empty()) continue;
    const Location home = partial->lives_on_fractures() ? Location::fracture_cell : Location::cell;
    for (OutputField& field : fields)
      if (field.location == home && field.name.starts_with(component->name() + "."))
        for (int c = 0; c < entity_count(mesh_, home); ++c)
          if (!partial->inhabited_cells()[c])
            field.values.segment(c * field.components, field.components)
                .setConstant(std::numeric_limits<double>::quiet_NaN());
  }
}

std::vector<OutputField> Model::derived_output() const {
  std::vector<OutputField> fields;
  for (const Part* part : parts_) part->output(fields);
  return fields;
}

}  // namespace sprekk
