#include "components/poromechanics/rock.hpp"

#include <utility>

#include "framework/field/ownership.hpp"
#include "framework/invariants.hpp"

namespace sprekk::poromechanics {

Rock::Rock(const ComponentContext& context, const Options& options, const StressDiscretization& discretization)
    : LoadedRock(context, options, Location::cell), stress_discretization_(discretization) {
  for (const auto& [side, condition] : options.boundary)
    if (condition.has_spring())
      throw InputError(condition.origin, "side '" + side + "' of '" + name() + "' cannot rest on springs",
                       "its displacement is no unknown: this component has those of cells",
                       "take poromechanics/fem, or hold the side");
  for (const auto& [point, given] : options.pinned)
    throw InputError(given.origin, "the point '" + point + "' of '" + name() + "' cannot be pinned",
                     "this component has displacements of cells, and none of points",
                     "take poromechanics/fem, or hold sides");
  add_wall_traction(context.fields);
  if (!wall_traction_) return;
  wall_remainder_ = &context.fields.add(
      mesh_, {.owner = context.name,
              .name = "wall_remainder",
              .location = Location::fracture_cell,
              .components = dimension,
              .role = Role::derived(),
              .unit = "Pa",
              .doc = "Difference that a change of the mesh makes to the traction on the plus wall, at the same jumps"});
}

void Rock::begin_step(const StepTime& step) {
  evaluate_data(step);
  discretize();
  use_loads();
  apply_boundary();
}

void Rock::assemble(Assembly& assembly, const StepTime&) const {
  if (!assembly.has_row(displacement_)) return;
  SPREKK_EXPECT(is_discretized() && loads_applied_, name());
  SPREKK_ASSERT(force_constant_.size() == displacement_.size(), force_constant_.size(), displacement_.size());
  assembly.linear(displacement_, force_of_displacement_, displacement_);
  if (wall_traction_) assembly.linear(displacement_, force_of_wall_traction_, *wall_traction_);
  for (std::size_t i = 0; i < loads_.size(); ++i)
    assembly.linear(displacement_, force_of_load_[i].on_cell, *loads_[i].pressure);
  assembly.add(displacement_, force_constant_);
}

void Rock::settled(const MeshChange& change) {
  if (!wall_remainder_ || !change.is_at_rest) return;
  wall_remainder_->set_both(wall_load() - carried_traction_);
  wall_traction_->set_both(std::exchange(carried_traction_, {}));
  loads_applied_ = false;
  apply_boundary();
}

void Rock::count_from_equilibrium() {
  SPREKK_EXPECT(is_discretized() && loads_applied_, name());
  Vector forces = face_forces(), displacements = boundary_values_;
  exchange(mesh_, Location::face, dimension, forces);
  for (int f = 0; f < mesh_.face_count(); ++f)
    for (int k = 0; k < dimension; ++k)
      if (conditions_[f][k] != MechanicalCondition::displacement) displacements[dimension * f + k] = 0;
  keep_settled(std::move(forces), std::move(displacements));
  displacement_.set_both(Vector::Zero(displacement_.size()));
}

}  // namespace sprekk::poromechanics
