#include "components/poromechanics/rock.hpp"

#include <algorithm>
#include <utility>

#include "components/poromechanics/check_conditions.hpp"
#include "components/poromechanics/principal_stress.hpp"
#include "components/poromechanics/stress_without_displacement.hpp"
#include "framework/field/ownership.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/cell_mean.hpp"
#include "framework/mesh/cell_sums.hpp"
#include "framework/mesh/mesh_change.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk::poromechanics {

namespace {

/// Replaces the term of a field.
void put_term(LinearExpression& expression, const Field* field, Operator matrix) {
  for (LinearExpression::Term& term : expression.terms)
    if (term.field == field) {
      term.matrix = std::move(matrix);
      return;
    }
  expression.terms.push_back({field, std::move(matrix)});
}

}  // namespace

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

void Rock::map_walls() {
  // Force on the plus wall: L (T_n n + T_t t); opposite on the minus wall. Jump: minus less plus (Eqs. 4 and 1 of the
  // paper).
  std::vector<Triplet> forces, jumps;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    const FractureCell& cell = mesh_.fracture_cells[i];
    const Point axes[2] = {cell.normal, cell.tangents};
    const bool owned = is_owned(mesh_, Location::fracture_cell, i);
    for (int side = 0; side < 2; ++side)
      for (int axis = 0; axis < dimension; ++axis)
        for (int k = 0; k < dimension; ++k) {
          const double sign = side == 0 ? 1.0 : -1.0;
          const int row = dimension * cell.faces[side] + k, column = dimension * i + axis;
          forces.emplace_back(row, column, sign * cell.measure * axes[axis][k]);
          if (owned) jumps.emplace_back(column, row, -sign * axes[axis][k]);
        }
  }
  wall_forces_.resize(dimension * mesh_.face_count(), dimension * mesh_.fracture_cell_count());
  wall_forces_.setFromTriplets(forces.begin(), forces.end());
  wall_jump_.resize(dimension * mesh_.fracture_cell_count(), dimension * mesh_.face_count());
  wall_jump_.setFromTriplets(jumps.begin(), jumps.end());
}

void Rock::find_conditions() {
  conditions_.assign(mesh_.face_count(), {});
  for (int f = 0; f < mesh_.face_count(); ++f) {
    if (mesh_.face_cells[f][1] != none) {
      if (may_have_initial_load(f)) conditions_[f] = {MechanicalCondition::load, MechanicalCondition::load};
      continue;
    }
    conditions_[f] = {MechanicalCondition::traction, MechanicalCondition::traction};
    const SideCondition* condition = condition_of(options_, mesh_, f);
    if (!condition) continue;
    conditions_[f].axes = condition->axes();
    for (int k = 0; k < dimension; ++k)
      if (condition->displacement_of(k)) conditions_[f][k] = MechanicalCondition::displacement;
  }
}

bool Rock::is_discretized() const {
  return discretized_mesh_ == mesh_.version && discretized_stiffness_ == stiffness_.version();
}

void Rock::discretize() {
  if (is_discretized()) return;
  find_conditions();
  if (!stiffness_of_operators_.empty())
    return discretize_from({mesh_, stiffness_of_operators_, conditions_}, operators_, no_change(mesh_));
  const std::vector<char> nodes = nodes_to_discretize(mesh_);
  discretized_cells_ += mesh_.cell_count();
  discretized_regions_ += nodes.empty() ? mesh_.node_count() : std::count(nodes.begin(), nodes.end(), 1);
  StressOperators made = stress_discretization_.discretize({mesh_, stiffness_.of_cells(), conditions_}, nodes);
  operators_.swap(made);
  use_operators();
}

void Rock::carry_over(const Part& part, const MeshChange& change) {
  const Rock& before = dynamic_cast<const Rock&>(part);
  SPREKK_EXPECT(static_cast<int>(change.cell.size()) == mesh_.cell_count(), change.cell.size(), mesh_.cell_count());
  if (wall_remainder_ && change.is_at_rest) carried_traction_ = wall_traction_->accepted();
  if (wall_remainder_ && !change.is_at_rest)
    wall_remainder_->set_both(covered_parts(change, mesh_).prod() * wall_remainder_->accepted());
  // With several processes, cells may have moved to other processes.
  if (parallel::size() > 1 || !before.is_discretized()) return;
  find_conditions();
  discretize_from({before.mesh_, before.stiffness_.of_cells(), before.conditions_}, before.operators_, change);
}

void Rock::settled(const MeshChange& change) {
  if (!wall_remainder_ || !change.is_at_rest) return;
  wall_remainder_->set_both(wall_load() - carried_traction_);
  wall_traction_->set_both(std::exchange(carried_traction_, {}));
  boundary_applied_ = false;
  apply_boundary();
}

void Rock::discretize_from(const StressInputs& before, const StressOperators& operators, const MeshChange& change) {
  Rediscretized result =
      stress_discretization_.rediscretize(before, operators, {mesh_, stiffness_.of_cells(), conditions_}, change);
  discretized_cells_ += result.cells;
  discretized_regions_ += result.regions;
  operators_.swap(result.operators);
  use_operators();
}

void Rock::use_operators() {
  discretized_mesh_ = mesh_.version;
  discretized_stiffness_ = stiffness_.version();
  if (stiffness_.changes() && parallel::size() == 1) stiffness_of_operators_ = stiffness_.of_cells();
  ++discretizations_;
  boundary_applied_ = false;
  const int rank = parallel::rank();
  if (parallel::size() > 1) {
    // Rows of other ranks' cells are incomplete.
    std::vector<char> own(mesh_.cell_count());
    for (int c = 0; c < mesh_.cell_count(); ++c) own[c] = mesh_.cell_rank[c] == rank;
    for (SparseMatrix* rows : {&operators_.volume_displacement, &operators_.volume_stress, &operators_.volume_boundary})
      *rows = keep_rows(*rows, own);
  }
  if (const Excavation& excavation = stiffness_.excavation(); !excavation.is_empty())
    for (SparseMatrix* rows : {&operators_.volume_displacement, &operators_.volume_stress, &operators_.volume_boundary})
      *rows = keep_rows(*rows, excavation.left());
  const SparseMatrix outflow = cell_sums(mesh_, operators_.force_displacement, dimension, rank);
  SPREKK_ASSERT(operators_.force_displacement.rows() == dimension * mesh_.face_count(),
                operators_.force_displacement.rows());
  SPREKK_ASSERT(operators_.force_displacement.cols() == displacement_.size(), operators_.force_displacement.cols());
  SPREKK_ASSERT(operators_.volume_displacement.rows() == mesh_.cell_count(), operators_.volume_displacement.rows());
  SPREKK_ASSERT(is_finite(operators_.force_displacement) && is_finite(operators_.force_boundary));
  force_of_displacement_ = Operator(-outflow);
  volume_change_.terms = {{&displacement_, Operator(operators_.volume_displacement)}};
  if (wall_traction_) {
    map_walls();
    force_of_wall_traction_ =
        Operator(-cell_sums(mesh_, SparseMatrix(operators_.force_boundary * wall_forces_), dimension, rank));
    volume_change_.terms.push_back({wall_traction_, Operator(operators_.volume_boundary * wall_forces_)});
    jump_.terms = {{&displacement_, Operator(wall_jump_ * operators_.trace_displacement)},
                   {wall_traction_, Operator(wall_jump_ * operators_.trace_boundary * wall_forces_)}};
  }
  for (Load& load : loads_) load.used_version = 0;
  use_loads();
}

void Rock::use_loads() {
  for (Load& load : loads_) {
    if (load.used_version == load.alpha_version) continue;
    load.used_version = load.alpha_version;
    boundary_applied_ = false;
    const SparseMatrix force = cell_sums(mesh_, operators_.force_stress, dimension, parallel::rank());
    load.force_on_cell = Operator(-force * load.alpha.asDiagonal());
    put_term(volume_change_, load.pressure, Operator(operators_.volume_stress * load.alpha.asDiagonal()));
    if (wall_traction_)
      put_term(jump_, load.pressure, Operator(wall_jump_ * operators_.trace_stress * load.alpha.asDiagonal()));
  }
}

Point Rock::initial_traction(int face, int side) const {
  const int cell = mesh_.face_cells[face][side];
  const double support = stiffness_.excavation().support(cell);
  if (settled_) return support / mesh_.face_measure[face] * settled_->forces.segment<dimension>(dimension * face);
  if (options_.initial_stress.is_zero()) return Point::Zero();
  const Place place{mesh_.face_center[face], mesh_.cell_region[cell], 0};
  return support * (options_.initial_stress.at(place) * mesh_.face_normal[face]);
}

bool Rock::may_have_initial_load(int face) const {
  const auto [one, other] = mesh_.face_cells[face];
  const Excavation& excavation = stiffness_.excavation();
  return !initial_load(face).isZero(0) || excavation.is_excavated(one) != excavation.is_excavated(other);
}

void Rock::use_excavation() {
  const Excavation& excavation = stiffness_.excavation();
  if (excavation.version() == used_excavation_) return;
  used_excavation_ = excavation.version();
  for (Load& load : loads_) {
    load.alpha = excavation.of_rock(load.given);
    ++load.alpha_version;
  }
}

Point Rock::initial_load(int face) const {
  const auto [one, other] = mesh_.face_cells[face];

  if (other == none || mesh_.cell_region[one] == mesh_.cell_region[other]) return Point::Zero();
  return mesh_.face_measure[face] * (initial_traction(face, 1) - initial_traction(face, 0));
}

void Rock::evaluate_data(const StepTime& step) {
  const bool same_step = evaluated_for_.start == step.start && evaluated_for_.end == step.end;
  if (data_evaluated_ && (same_step || !(stiffness_.changes() || options_.loads_depend_on_time()))) return;
  data_evaluated_ = true;
  evaluated_for_ = step;
  boundary_applied_ = false;
  stiffness_.evaluate(step);
  use_excavation();

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
  }
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
  if (boundary_applied_) return;
  boundary_applied_ = true;
  SPREKK_ASSERT(is_finite(boundary_values_) && is_finite(initial_forces_) && is_finite(body_forces_));
  SPREKK_ASSERT(boundary_values_.size() == dimension * mesh_.face_count(), boundary_values_.size());
  force_constant_ = -cell_sums(mesh_, Vector(operators_.force_boundary * boundary_values_ + initial_forces_), 2);
  force_constant_ -= body_forces_;
  if (wall_remainder_) force_constant_ += force_of_wall_traction_.entries() * wall_remainder_->now();
  if (parallel::size() > 1)
    for (int c = 0; c < mesh_.cell_count(); ++c)
      if (!is_owned(mesh_, Location::cell, c)) force_constant_.segment<dimension>(dimension * c).setZero();
  Vector values = boundary_values_;
  if (wall_remainder_) values += wall_forces_ * wall_remainder_->now();
  volume_change_.constant = operators_.volume_boundary * values;
  if (wall_traction_) jump_.constant = wall_jump_ * (operators_.trace_boundary * values);
  if (wall_traction_ && settled_)
    for (int i = 0; i < mesh_.fracture_cell_count(); ++i)
      if (is_owned(mesh_, Location::fracture_cell, i))
        jump_.constant.segment<dimension>(dimension * i) += settled_->jumps.segment<dimension>(dimension * i);
  for (const Load& load : loads_) {
    const Vector reference = load.alpha.cwiseProduct(load.reference);
    force_constant_ -= load.force_on_cell.entries() * load.reference;
    volume_change_.constant -= operators_.volume_stress * reference;
    if (wall_traction_) jump_.constant -= wall_jump_ * (operators_.trace_stress * reference);
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

Vector Rock::face_forces() const {
  Vector values = boundary_values_;
  if (wall_traction_) values += wall_forces_ * wall_load();
  Vector forces = operators_.force_displacement * displacement_.now() + operators_.force_boundary * values;
  for (const Load& load : loads_) forces += operators_.force_stress * load.stress();
  for (int f = 0; f < mesh_.face_count(); ++f)
    forces.segment<dimension>(dimension * f) += mesh_.face_measure[f] * initial_traction(f, 0);
  return forces;
}

void Rock::count_from_here() {
  SPREKK_EXPECT(is_discretized() && boundary_applied_, name());
  SettledRock settled;
  settled.forces = face_forces();
  replicate(mesh_, Location::face, dimension, settled.forces);
  settled.stress = mean_stress();
  settled.displacements = boundary_values_;
  for (int f = 0; f < mesh_.face_count(); ++f)
    for (int k = 0; k < dimension; ++k)
      if (conditions_[f][k] != MechanicalCondition::displacement) settled.displacements[dimension * f + k] = 0;
  if (wall_traction_) {
    settled.jumps = jump_.now();
    replicate(mesh_, Location::fracture_cell, dimension, settled.jumps);
  }
  settled_ = std::move(settled);
  displacement_.set_both(Vector::Zero(displacement_.size()));
  data_evaluated_ = false;
  begin_step(StepTime(evaluated_for_));
}

void Rock::save(std::map<std::string, Vector>& state) const {
  if (settled_) settled_->save(name(), state);
}

void Rock::restore(const std::map<std::string, Vector>& state) {
  settled_ = SettledRock::restored(name(), state);
  data_evaluated_ = false;
}

Vector Rock::outer_displacement() const {
  Vector values = boundary_values_;
  if (wall_traction_) values += wall_forces_ * wall_load();
  Vector displacement = operators_.trace_displacement * displacement_.now() + operators_.trace_boundary * values;
  for (const Load& load : loads_) displacement += operators_.trace_stress * load.stress();
  replicate(mesh_, Location::face, dimension, displacement);
  return displacement;
}

Vector Rock::pore_stress() const {
  Vector stress = Vector::Zero(mesh_.cell_count());
  for (const Load& load : loads_) stress -= load.stress();
  return stress;
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

Vector Rock::stress_of(const Vector& forces, const Vector& moments) const {
  // Of a cell from the forces on its faces: V sigma = sum of force ⊗ (x_face − x_cell), exact when constant, and near
  // tips of cracks with the moments of the singular tractions about the centres of the faces.
  Vector stress = Vector::Zero(3 * mesh_.cell_count());
  for (int c = 0; c < mesh_.cell_count(); ++c)
    for (const int face : mesh_.cell_faces[c]) {
      const double sign = mesh_.face_cells[face][0] == c ? 1 : -1;
      const Point force = sign * forces.segment<dimension>(dimension * face);
      const Point arm = (mesh_.face_center[face] - mesh_.cell_center[c]) / mesh_.cell_measure[c];
      stress.segment<3>(3 * c) +=
          Eigen::Vector3d(force[0] * arm[0], force[1] * arm[1], 0.5 * (force[0] * arm[1] + force[1] * arm[0])) +
          sign / mesh_.cell_measure[c] * moments.segment<3>(3 * face);
    }
  return stress;
}

Vector Rock::mean_stress() const {
  if (discretizations_ == 0 || (!settled_ && displacement_.now().isZero(0)))
    return stress_without_displacement(mesh_, options_, pore_stress());
  Vector stress = stress_of(face_forces(), operators_.moment_displacement * displacement_.now());
  if (settled_) {
    const Vector of_moments = settled_->stress - stress_of(settled_->forces, Vector::Zero(3 * mesh_.face_count()));
    for (int c = 0; c < mesh_.cell_count(); ++c)
      stress.segment<3>(3 * c) += stiffness_.excavation().support(c) * of_moments.segment<3>(3 * c);
  }
  replicate(mesh_, Location::cell, 3, stress);
  return stress;
}

void Rock::output(std::vector<OutputField>& fields) const { output_stress(name(), mean_stress(), fields); }

}  // namespace sprekk::poromechanics
