// The loads on the rock that the scene gives: initial stress, sides, weight, and what is taken away.
#include "components/poromechanics/check_conditions.hpp"
#include "components/poromechanics/rock.hpp"
#include "framework/field/ownership.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/cell_mean.hpp"
#include "framework/mesh/cell_sums.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk::poromechanics {

Point Rock::initial_traction(int face, int side) const {
  const int cell = mesh_.face_cells[face][side];
  const double support = stiffness_.excavation().support(cell);
  if (settled_) return support / mesh_.face_measure[face] * settled_->forces.segment<dimension>(dimension * face);
  if (options_.initial_stress.is_zero()) return Point::Zero();
  const Place place{mesh_.face_center[face], mesh_.cell_region[cell], 0};
  return support * (options_.initial_stress.at(place) * mesh_.face_normal[face]);
}

Point Rock::initial_load(int face) const {
  const auto [one, other] = mesh_.face_cells[face];

  if (other == none || mesh_.cell_region[one] == mesh_.cell_region[other]) return Point::Zero();
  return mesh_.face_measure[face] * (initial_traction(face, 1) - initial_traction(face, 0));
}

bool Rock::may_have_initial_load(int face) const {
  const auto [one, other] = mesh_.face_cells[face];
  const Excavation& excavation = stiffness_.excavation();
  return !initial_load(face).isZero(0) || excavation.is_excavated(one) != excavation.is_excavated(other);
}

void Rock::subtract_settled_spring(int face) {
  const SideCondition& condition = *condition_of(options_, mesh_, face);
  const Place place{mesh_.face_center[face], mesh_.cell_region[mesh_.face_cells[face][0]], 0};
  const Tensor axes = axes_of(condition.axes(), mesh_.face_normal[face]);
  Point moved = settled_->displacements.segment<dimension>(dimension * face);
  for (int k = 0; k < dimension; ++k)
    if (condition.displacement_of(k)) moved[k] = 0;
  boundary_values_.segment<dimension>(dimension * face) -=
      mesh_.face_measure[face] *
      (axes.transpose() * condition.spring_at(place, mesh_.face_normal[face]) * axes * moved);
}

void Rock::evaluate_data(const StepTime& step) {
  if (!evaluate(step)) return;
  boundary_values_ = Vector::Zero(dimension * mesh_.face_count());
  initial_forces_ = Vector::Zero(dimension * mesh_.face_count());
  for (int f = 0; f < mesh_.face_count(); ++f) {
    const double length = mesh_.face_measure[f];
    const Point initial = initial_traction(f, 0);
    initial_forces_.segment<dimension>(dimension * f) = length * initial;
    if (mesh_.face_cells[f][1] != none) {
      boundary_values_.segment<dimension>(dimension * f) = initial_load(f);
      continue;
    }
    // Prescribed tractions are those of the total stress; the stress of the deformation is the total less the initial
    // one.
    boundary_values_.segment<dimension>(dimension * f) = -length * initial;
    const SideCondition* condition = condition_of(options_, mesh_, f);
    if (!condition) continue;
    const Place place{mesh_.face_center[f], mesh_.cell_region[mesh_.face_cells[f][0]], 0};
    boundary_values_.segment<dimension>(dimension * f) +=
        length * condition->traction_in(step, place, mesh_.face_normal[f]);
    if (condition->axes() == ConditionAxes::of_face)
      boundary_values_.segment<dimension>(dimension * f) =
          axes_of(condition->axes(), mesh_.face_normal[f]).transpose() *
          Point(boundary_values_.segment<dimension>(dimension * f));
    for (int k = 0; k < dimension; ++k)
      if (const Data* displacement = condition->displacement_of(k))
        boundary_values_[dimension * f + k] =
            value_in_step(*displacement, place, step) - (settled_ ? settled_->displacements[dimension * f + k] : 0);
    if (settled_ && condition->has_spring()) subtract_settled_spring(f);
  }
  pinned_displacements_ = pinned_.displacements(step);
  if (settled_) pinned_displacements_ -= settled_->displacements.tail(pinned_displacements_.size());
  body_forces_ = Vector::Zero(dimension * mesh_.cell_count());
  const bool vary = options_.body_force.depends_on_space() || options_.rock_density.depends_on_space() ||
                    options_.gravity.depends_on_space();
  for (int c = 0; c < mesh_.cell_count(); ++c) {
    const auto density = [&](const Point& at) -> Point {
      const Place place{at, mesh_.cell_region[c], 0};
      return options_.body_force_in(step, place);
    };
    body_forces_.segment<dimension>(dimension * c) =
        stiffness_.excavation().support(c) * mesh_.cell_measure[c] *
        (vary ? cell_mean(mesh_, c, density) : density(mesh_.cell_center[c]));
  }
}

void Rock::apply_boundary() {
  if (loads_applied_) return;
  loads_applied_ = true;
  SPREKK_ASSERT(is_finite(boundary_values_) && is_finite(initial_forces_) && is_finite(body_forces_));
  SPREKK_ASSERT(boundary_values_.size() == dimension * mesh_.face_count(), boundary_values_.size());
  force_constant_ =
      -cell_sums(mesh_, Vector(operators_.force_boundary * boundary_values_ + initial_forces_), dimension);
  force_constant_ -= body_forces_;
  if (wall_remainder_) force_constant_ += force_of_wall_traction_.entries() * wall_remainder_->now();
  pinned_.give(pinned_displacements_, force_constant_);
  if (parallel::size() > 1)
    for (int c = 0; c < mesh_.cell_count(); ++c)
      if (!is_owned(mesh_, Location::cell, c)) force_constant_.segment<dimension>(dimension * c).setZero();
  Vector values = boundary_values_;
  if (wall_remainder_) values += wall_forces_ * wall_remainder_->now();
  volume_change_.constant = operators_.volume_boundary * values;
  if (wall_traction_) jump_.constant = wall_jump_ * (operators_.trace_boundary * values);
  add_jumps(jump_.constant);
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    const PoreLoad& load = loads_[i];
    const Vector reference = load.alpha.cwiseProduct(load.reference);
    force_constant_ -= force_of_load_[i].on_cell.entries() * load.reference;
    volume_change_.constant -= operators_.volume_stress * reference;
    if (wall_traction_) jump_.constant -= wall_jump_ * (operators_.trace_stress * reference);
  }
}

}  // namespace sprekk::poromechanics
