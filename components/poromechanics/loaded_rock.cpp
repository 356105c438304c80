#include "components/poromechanics/loaded_rock.hpp"

#include <algorithm>

#include "components/poromechanics/check_conditions.hpp"
#include "components/poromechanics/principal_stress.hpp"
#include "framework/field/ownership.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/mesh_change.hpp"

namespace sprekk::poromechanics {

LoadedRock::LoadedRock(const ComponentContext& context, const Options& options, Location location)
    : Component(context.name),
      mesh_(context.mesh),
      options_(options),
      origin_(context.origin),
      displacement_(context.fields.add(mesh_, {.owner = context.name,
                                               .name = "displacement",
                                               .location = location,
                                               .components = dimension,
                                               .role = Role::unknown(BlockKind::bulk_elastic),
                                               .unit = "m",
                                               .doc = "Displacement of the rock"})),
      stiffness_(options_, mesh_, context.start_time, context.name, context.origin),
      start_time_(context.start_time) {
  check_conditions(options_, mesh_, location, context.origin);
  if (!options_.is_anisotropic) young_ = FormulaOfCells::find({*options_.young_modulus}, mesh_);
}

LoadedRock::~LoadedRock() = default;

void LoadedRock::offer_state(const std::string& variable, const StateField& source) {
  if (!young_ || !young_->state().names(variable)) return;
  if (std::ranges::count(offered_, variable) > 0)
    throw InputError(origin_, "the formula of 'young_modulus' names " + quoted(variable),
                     "two components give it to '" + name() + "'", "couple one of them with the rock");
  offered_.push_back(variable);
  young_->state().offer(variable, source);
  take_initial_young();
}

/// Strains are zero in the initial state.
void LoadedRock::take_initial_young() {
  if (!young_ || !young_->state().has_all()) return;
  young_->evaluate({start_time_, 0, start_time_});
  use_initial_young(young_->values());
}

void LoadedRock::use_initial_young(const Vector& values) {
  SPREKK_EXPECT(values.size() == mesh_.cell_count(), values.size());
  initial_young_ = values;
  ratio_ = Vector::Ones(mesh_.cell_count());
  stiffness_.set_initial_young_modulus(initial_young_);
}

void LoadedRock::keep_references(const LoadedRock& before, const MeshChange& change) {
  SPREKK_EXPECT(loads_.size() == before.loads_.size(), loads_.size(), before.loads_.size());
  const auto measures = [](const Mesh& mesh) {
    return Eigen::Map<const Eigen::ArrayXd>(mesh.cell_measure.data(), mesh.cell_count());
  };
  for (std::size_t k = 0; k < loads_.size(); ++k) {
    const Vector& old = before.loads_[k].reference;
    const Vector sums = shared_in_cells(change, before.mesh_, (old.array() * measures(before.mesh_)).matrix());
    for (int c = 0; c < mesh_.cell_count(); ++c)
      loads_[k].reference[c] = change.cell[c] != none ? old[change.cell[c]] : sums[c] / mesh_.cell_measure[c];
  }
}

void LoadedRock::require_state() const {
  if (!young_) return;
  young_->state().require("young_modulus", origin_, [&](const std::string& variable) {
    return variable == "p"
               ? "add a flow in the rock, and a coupler biot with '" + name() + "'"
               : "add a component of the heat in the rock, and a coupler thermal_stress with '" + name() + "'";
  });
}

void LoadedRock::let_alpha_follow_stiffness(const Field& pressure) {
  if (!young_) return;
  for (PoreLoad& load : loads_) load.follows_stiffness = load.follows_stiffness || load.pressure == &pressure;
}

bool LoadedRock::take_young() {
  const Excavation& excavation = stiffness_.excavation();
  std::vector<char> inside(mesh_.cell_count(), 1);
  for (int c = 0; c < mesh_.cell_count(); ++c) inside[c] = !excavation.is_removed(c);
  if (!young_->evaluate(evaluated_for_, inside)) return false;
  for (int c = 0; c < mesh_.cell_count(); ++c)
    if (inside[c]) ratio_[c] = young_->values()[c] / initial_young_[c];
  for (PoreLoad& load : loads_)
    if (load.follows_stiffness) load.ratio = ratio_;
  return true;
}

void LoadedRock::add_wall_traction(FieldStore& fields) {
  if (mesh_.wall_count() == 0) return;
  wall_traction_ = &fields.add(mesh_, {.owner = name(),
                                       .name = "wall_traction",
                                       .location = Location::fracture_cell,
                                       .components = dimension,
                                       .role = Role::input(BlockKind::interface),
                                       .unit = "Pa",
                                       .doc = "Traction on the plus wall, normal and tangential (the paper's Eq. 4)",
                                       .needs_coupler = dimension == 2 ? "" : "wall_traction"});
}

void LoadedRock::accept_pore_pressure(const Field& pressure, const Vector& alpha, const Vector& reference) {
  SPREKK_EXPECT(alpha.size() == mesh_.cell_count(), pressure.name(), alpha.size(), mesh_.cell_count());
  SPREKK_EXPECT(reference.size() == mesh_.cell_count(), pressure.name(), reference.size(), mesh_.cell_count());
  SPREKK_EXPECT(pressure.size() == mesh_.cell_count(), pressure.name(), pressure.size(), mesh_.cell_count());
  loads_.push_back({&pressure, alpha, reference, alpha});
}

void LoadedRock::change_alpha(const Field& pressure, const Vector& alpha) {
  SPREKK_EXPECT(alpha.size() == mesh_.cell_count(), pressure.name(), alpha.size(), mesh_.cell_count());
  for (PoreLoad& load : loads_) {
    if (load.pressure != &pressure) continue;
    load.given = alpha;
    load.change_alpha(stiffness_.excavation().of_rock(alpha));
  }
}

std::optional<LameParameters> LoadedRock::stiffness(int cell) const {
  std::optional<LameParameters> present = stiffness_.lame(cell);
  if (present && ratio_.size() > 0)
    present = LameParameters{ratio_[cell] * present->lambda, ratio_[cell] * present->shear};
  return present;
}

bool LoadedRock::evaluate(const StepTime& step) {
  const bool same_step = evaluated_for_.start == step.start && evaluated_for_.end == step.end;
  const bool may_change = young_ || stiffness_.changes() || options_.loads_depend_on_time();
  if (data_evaluated_ && (same_step || !may_change)) return false;
  data_evaluated_ = true;
  evaluated_for_ = step;
  loads_applied_ = false;
  stiffness_.evaluate(step);
  const Excavation& excavation = stiffness_.excavation();
  if (excavation.version() == used_excavation_) return true;
  used_excavation_ = excavation.version();
  for (PoreLoad& load : loads_) load.change_alpha(excavation.of_rock(load.given));
  return true;
}

std::uint64_t LoadedRock::alpha_version() const {
  std::uint64_t version = 1;
  for (const PoreLoad& load : loads_) version += load.alpha_version;
  return version;
}

void LoadedRock::count_from_here(const SettledFields& settled) {
  if (settled.fields.empty()) return;
  if (settled.contain(displacement_)) count_from_equilibrium();
  count_loads_from_here(settled, displacement_, loads_);
  data_evaluated_ = false;
  begin_step(StepTime(evaluated_for_));
}

void LoadedRock::keep_settled(Vector forces, Vector displacements) {
  SettledRock settled{std::move(forces), mean_stress(), std::move(displacements)};
  if (wall_traction_) {
    jumps_ = displacement_jump().now();
    exchange(mesh_, Location::fracture_cell, dimension, jumps_);
  }
  settled_ = std::move(settled);
}

void LoadedRock::count_jumps_from(const Vector& jumps) {
  SPREKK_EXPECT(wall_traction_ && jumps.size() == wall_traction_->size(), jumps.size());
  jumps_ = jumps;
  loads_applied_ = false;
}

void LoadedRock::add_jumps(Vector& owned) const {
  if (jumps_.size() == 0) return;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i)
    if (is_owned(mesh_, Location::fracture_cell, i))
      owned.segment<dimension>(dimension * i) += jumps_.segment<dimension>(dimension * i);
}

void LoadedRock::save(std::map<std::string, Vector>& state) const {
  if (settled_) settled_->save(name(), state);
  save_loads(name(), loads_, state);
  if (young_) state[key_of_young(name())] = initial_young_;
  if (jumps_.size() > 0) state[key_of_jumps(name())] = jumps_;
}

void LoadedRock::restore(const std::map<std::string, Vector>& state) {
  settled_ = SettledRock::restored(name(), state);
  restore_loads(name(), loads_, state);
  if (const auto kept = state.find(key_of_young(name())); young_ && kept != state.end())
    use_initial_young(kept->second);
  if (const auto kept = state.find(key_of_jumps(name())); kept != state.end()) jumps_ = kept->second;
  data_evaluated_ = false;
}

Vector LoadedRock::pore_stress() const {
  Vector stress = Vector::Zero(mesh_.cell_count());
  for (const PoreLoad& load : loads_) stress -= load.stress();
  return stress;
}

Vector LoadedRock::pore_stress_by(const Field& pressure) const {
  for (const PoreLoad& load : loads_)
    if (load.pressure == &pressure) return -load.present_alpha();
  return {};
}

SymmetricTensor LoadedRock::initial_stress(int cell, const Point& x) const {
  SPREKK_EXPECT(is_index(cell, mesh_.cell_count()), cell, mesh_.cell_count());
  const double support = stiffness_.excavation().support(cell);
  if (settled_) return support * settled_->stress.segment<symmetric_components>(symmetric_components * cell);
  return support * options_.initial_stress_at({x, mesh_.cell_region[cell], 0});
}

Point LoadedRock::body_force(int cell, const Point& x) const {
  SPREKK_EXPECT(is_index(cell, mesh_.cell_count()), cell, mesh_.cell_count());
  return stiffness_.excavation().support(cell) *
         options_.body_force_in(evaluated_for_, {x, mesh_.cell_region[cell], 0});
}

std::vector<double> LoadedRock::switch_times() const {
  std::vector<const Data*> data = stiffness_.data(), loads = options_.loads();
  data.insert(data.end(), loads.begin(), loads.end());
  return merged_switch_times(data);
}

void LoadedRock::output(std::vector<OutputField>& fields) const { output_stress(name(), mean_stress(), fields); }

}  // namespace sprekk::poromechanics
