// The matrices of cells, walls and pore pressures from the stress discretization; they are computed anew where mesh,
// stiffness or coefficients change.
#include <algorithm>
#include <utility>

#include "components/poromechanics/check_conditions.hpp"
#include "components/poromechanics/rock.hpp"
#include "framework/field/ownership.hpp"
#include "framework/invariants.hpp"
#include "framework/matrix_of.hpp"
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

void Rock::map_walls() {
  // Force on the plus wall: L (T_n n + T_t t); opposite on the minus wall. Jump: that of the minus wall minus that of
  // the plus wall (Eqs. 4 and 1 of the paper).
  std::vector<Triplet> forces, jumps;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    const FractureCell& cell = mesh_.fracture_cells[i];
    Tensor axes;  // the normal and the tangents, in columns
    axes << cell.normal, cell.tangents;
    const bool owned = is_owned(mesh_, Location::fracture_cell, i);
    for (int side = 0; side < 2; ++side)
      for (int axis = 0; axis < dimension; ++axis)
        for (int k = 0; k < dimension; ++k) {
          const double sign = side == 0 ? 1.0 : -1.0;
          const int row = dimension * cell.faces[side] + k, column = dimension * i + axis;
          forces.emplace_back(row, column, sign * cell.measure * axes(k, axis));
          if (owned) jumps.emplace_back(column, row, -sign * axes(k, axis));
        }
  }
  wall_forces_ = matrix_of(dimension * mesh_.face_count(), dimension * mesh_.fracture_cell_count(), forces);
  wall_jump_ = matrix_of(dimension * mesh_.fracture_cell_count(), dimension * mesh_.face_count(), jumps);
}

void Rock::find_conditions() {
  conditions_.assign(mesh_.face_count(), {});
  for (int f = 0; f < mesh_.face_count(); ++f) {
    if (mesh_.face_cells[f][1] != none) {
      if (may_have_initial_load(f)) conditions_[f].along.fill(MechanicalCondition::load);
      continue;
    }
    conditions_[f].along.fill(MechanicalCondition::traction);
    const SideCondition* condition = condition_of(options_, mesh_, f);
    if (!condition) continue;
    conditions_[f].axes = condition->axes();
    if (condition->has_spring()) {
      const Place place{mesh_.face_center[f], mesh_.cell_region[mesh_.face_cells[f][0]], 0};
      conditions_[f].spring = mesh_.face_measure[f] * condition->spring_at(place, mesh_.face_normal[f]);
    }
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
  if (!change.is_at_start) keep_references(before, change);
  if (wall_remainder_ && change.is_at_rest) carried_traction_ = wall_traction_->accepted();
  if (wall_remainder_ && !change.is_at_rest)
    wall_remainder_->set_both(covered_parts(change, mesh_).prod() * wall_remainder_->accepted());
  // With several processes, cells may have moved to other processes.
  if (parallel::size() > 1 || !before.is_discretized()) return;
  find_conditions();
  discretize_from({before.mesh_, before.stiffness_.of_cells(), before.conditions_}, before.operators_, change);
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
  loads_applied_ = false;
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
  force_of_displacement_ = Operator(pinned_.hold(-outflow));
  volume_change_.terms = {{&displacement_, Operator(operators_.volume_displacement)}};
  if (wall_traction_) {
    map_walls();
    force_of_wall_traction_ = Operator(
        pinned_.clear(-cell_sums(mesh_, SparseMatrix(operators_.force_boundary * wall_forces_), dimension, rank)));
    volume_change_.terms.push_back({wall_traction_, Operator(operators_.volume_boundary * wall_forces_)});
    jump_.terms = {{&displacement_, Operator(wall_jump_ * operators_.trace_displacement)},
                   {wall_traction_, Operator(wall_jump_ * operators_.trace_boundary * wall_forces_)}};
  }
  force_of_load_.clear();
  use_loads();
}

void Rock::use_loads() {
  force_of_load_.resize(loads_.size());
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    const PoreLoad& load = loads_[i];
    if (force_of_load_[i].used_version == load.alpha_version) continue;
    force_of_load_[i].used_version = load.alpha_version;
    loads_applied_ = false;
    const SparseMatrix force = cell_sums(mesh_, operators_.force_stress, dimension, parallel::rank());
    force_of_load_[i].on_cell = Operator(pinned_.clear(-force * load.alpha.asDiagonal()));
    put_term(volume_change_, load.pressure, Operator(operators_.volume_stress * load.alpha.asDiagonal()));
    if (wall_traction_)
      put_term(jump_, load.pressure, Operator(wall_jump_ * operators_.trace_stress * load.alpha.asDiagonal()));
  }
}

}  // namespace sprekk::poromechanics
