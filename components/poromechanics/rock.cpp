#include "components/poromechanics/rock.hpp"

#include <utility>

#include "framework/field/ownership.hpp"
#include "framework/invariants.hpp"

namespace sprekk::poromechanics {

Rock::Rock(const ComponentContext& context, const Options& options, const StressDiscretization& discretization)
    : LoadedRock(context, options, Location::cell), stress_discretization_(discretization), pinned_(options_, mesh_) {
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

Vector Rock::settled_displacements() const {
  const Vector now = outer_displacement();
  Vector displacements = Vector::Zero(boundary_values_.size());
  for (int f = 0; f < mesh_.face_count(); ++f) {
    const Point along =
        axes_of(conditions_[f].axes, mesh_.face_normal[f]).transpose() * Point(now.segment<dimension>(dimension * f));
    for (int k = 0; k < dimension; ++k)
      if (conditions_[f][k] == MechanicalCondition::displacement)
        displacements[dimension * f + k] = boundary_values_[dimension * f + k];
      else if (conditions_[f].has_spring())
        displacements[dimension * f + k] = along[k];
  }
  return displacements;
}

void Rock::count_from_equilibrium() {
  SPREKK_EXPECT(is_discretized() && loads_applied_, name());
  Vector forces = face_forces();
  exchange(mesh_, Location::face, dimension, forces);
  Vector displacements(boundary_values_.size() + pinned_displacements_.size());
  displacements << settled_displacements(), pinned_displacements_;
  keep_settled(std::move(forces), std::move(displacements));
  displacement_.set_both(Vector::Zero(displacement_.size()));
}

}  // namespace sprekk::poromechanics
