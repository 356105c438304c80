#include "components/poromechanics/rock.hpp"

#include <utility>

#include "components/poromechanics/check_conditions.hpp"
#include "framework/field/ownership.hpp"
#include "framework/invariants.hpp"

namespace sprekk::poromechanics {

Rock::Rock(const ComponentContext& context, const Options& options, const StressDiscretization& discretization)
    : Component(context.name),
      mesh_(context.mesh),
      options_(options),
      stress_discretization_(discretization),
      origin_(context.origin),
      displacement_(context.fields.add(mesh_, {.owner = context.name,
                                               .name = "displacement",
                                               .location = Location::cell,
                                               .components = 2,
                                               .role = Role::unknown(BlockKind::bulk_elastic),
                                               .unit = "m",
                                               .doc = "Displacement of the rock"})),
      stiffness_(options_, mesh_, context.start_time, context.name, context.origin) {
  check_conditions(options_, mesh_, context.origin);
  if (mesh_.wall_count() == 0) return;
  wall_traction_ =
      &context.fields.add(mesh_, {.owner = context.name,
                                  .name = "wall_traction",
                                  .location = Location::fracture_cell,
                                  .components = 2,
                                  .role = Role::input(BlockKind::interface),
                                  .unit = "Pa",
                                  .doc = "Traction on the plus wall, normal and tangential (the paper's Eq. 4)"});
  wall_remainder_ = &context.fields.add(
      mesh_, {.owner = context.name,
              .name = "wall_remainder",
              .location = Location::fracture_cell,
              .components = 2,
              .role = Role::derived(),
              .unit = "Pa",
              .doc = "Difference that a change of the mesh makes to the traction on the plus wall, at the same jumps"});
}

void Rock::accept_pore_pressure(const Field& pressure, const Vector& alpha, const Vector& reference) {
  SPREKK_EXPECT(alpha.size() == mesh_.cell_count(), pressure.name(), alpha.size(), mesh_.cell_count());
  SPREKK_EXPECT(reference.size() == mesh_.cell_count(), pressure.name(), reference.size(), mesh_.cell_count());
  SPREKK_EXPECT(pressure.size() == mesh_.cell_count(), pressure.name(), pressure.size(), mesh_.cell_count());
  loads_.push_back({{&pressure, alpha, reference, alpha}, {}});
}

void Rock::change_alpha(const Field& pressure, const Vector& alpha) {
  SPREKK_EXPECT(alpha.size() == mesh_.cell_count(), pressure.name(), alpha.size(), mesh_.cell_count());
  for (Load& load : loads_) {
    if (load.pressure != &pressure) continue;
    load.given = alpha;
    load.alpha = stiffness_.excavation().of_rock(alpha);
    ++load.alpha_version;
  }
}

void Rock::begin_step(const StepTime& step) {
  evaluate_data(step);
  discretize();
  use_loads();
  apply_boundary();
}

void Rock::assemble(Assembly& assembly, const StepTime&) const {
  if (!assembly.has_row(displacement_)) return;
  SPREKK_EXPECT(is_discretized() && boundary_applied_, name());
  SPREKK_ASSERT(force_constant_.size() == displacement_.size(), force_constant_.size(), displacement_.size());
  assembly.linear(displacement_, force_of_displacement_, displacement_);
  if (wall_traction_) assembly.linear(displacement_, force_of_wall_traction_, *wall_traction_);
  for (const Load& load : loads_) assembly.linear(displacement_, load.force_on_cell, *load.pressure);
  assembly.add(displacement_, force_constant_);
}

void Rock::settled(const MeshChange& change) {
  if (!wall_remainder_ || !change.is_at_rest) return;
  wall_remainder_->set_both(wall_load() - carried_traction_);
  wall_traction_->set_both(std::exchange(carried_traction_, {}));
  boundary_applied_ = false;
  apply_boundary();
}

void Rock::count_from_here(const SettledFields& settled) {
  if (settled.fields.empty()) return;
  SPREKK_EXPECT(is_discretized() && boundary_applied_, name());
  if (settled.contain(displacement_)) count_from_equilibrium();
  count_loads_from_here(settled, displacement_, loads_);
  data_evaluated_ = false;
  begin_step(StepTime(evaluated_for_));
}

void Rock::count_from_equilibrium() {
  SettledRock settled;
  settled.forces = face_forces();
  exchange(mesh_, Location::face, dimension, settled.forces);
  settled.stress = mean_stress();
  settled.displacements = boundary_values_;
  for (int f = 0; f < mesh_.face_count(); ++f)
    for (int k = 0; k < dimension; ++k)
      if (conditions_[f][k] != MechanicalCondition::displacement) settled.displacements[dimension * f + k] = 0;
  if (wall_traction_) {
    jumps_ = jump_.now();
    exchange(mesh_, Location::fracture_cell, dimension, jumps_);
  }
  settled_ = std::move(settled);
  displacement_.set_both(Vector::Zero(displacement_.size()));
}

void Rock::count_jumps_from(const Vector& jumps) {
  SPREKK_EXPECT(wall_traction_ && jumps.size() == wall_traction_->size(), jumps.size());
  jumps_ = jumps;
  boundary_applied_ = false;
}

void Rock::save(std::map<std::string, Vector>& state) const {
  if (settled_) settled_->save(name(), state);
  save_loads(name(), loads_, state);
  if (jumps_.size() > 0) state[key_of_jumps(name())] = jumps_;
}

void Rock::restore(const std::map<std::string, Vector>& state) {
  settled_ = SettledRock::restored(name(), state);
  restore_loads(name(), loads_, state);
  if (const auto kept = state.find(key_of_jumps(name())); kept != state.end()) jumps_ = kept->second;
  data_evaluated_ = false;
}

SymmetricTensor Rock::initial_stress(int cell, const Point& x) const {
  SPREKK_EXPECT(is_index(cell, mesh_.cell_count()), cell, mesh_.cell_count());
  const double support = stiffness_.excavation().support(cell);
  if (settled_) return support * settled_->stress.segment<3>(3 * cell);
  return support * options_.initial_stress_at({x, mesh_.cell_region[cell], 0});
}

Point Rock::body_force(int cell, const Point& x) const {
  SPREKK_EXPECT(is_index(cell, mesh_.cell_count()), cell, mesh_.cell_count());
  return stiffness_.excavation().support(cell) *
         options_.body_force_in(evaluated_for_, {x, mesh_.cell_region[cell], 0});
}

std::uint64_t Rock::properties_version() const {
  std::uint64_t version = stiffness_.version();
  for (const Load& load : loads_) version += load.alpha_version;
  return version;
}

std::vector<double> Rock::switch_times() const {
  std::vector<const Data*> data = stiffness_.data(), loads = options_.loads();
  data.insert(data.end(), loads.begin(), loads.end());
  return merged_switch_times(data);
}

}  // namespace sprekk::poromechanics
