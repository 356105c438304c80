// The discrete operators of the flow: when they are made, and what follows from them.
#include <algorithm>

#include "components/matrix_flow/flow_inside.hpp"
#include "components/matrix_flow/history_of_cells.hpp"
#include "components/matrix_flow/matrix_flow.hpp"
#include "framework/assembly/products.hpp"
#include "framework/discretization/changes_along_face.hpp"
#include "framework/field/ownership.hpp"
#include "framework/field/wall_matrices.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/cell_sums.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk::matrix_flow {
namespace {

/// For rock without permeability: pressures on faces are means of those of the cells beside, and drive no flux.
FacePressureOperators means_on_faces(const Mesh& mesh) {
  FacePressureOperators operators;
  operators.flux.resize(mesh.face_count(), mesh.face_count());
  operators.trace.resize(mesh.face_count(), mesh.face_count());
  operators.continuity_cell.resize(mesh.face_count(), mesh.cell_count());
  operators.continuity_boundary.resize(mesh.face_count(), mesh.face_count());
  std::vector<Triplet> means;
  for (int f = 0; f < mesh.face_count(); ++f) {
    const auto [cell, other] = mesh.face_cells[f];
    means.emplace_back(f, cell, other == none ? -1 : -0.5);
    if (other != none) means.emplace_back(f, other, -0.5);
  }
  operators.continuity_cell.setFromTriplets(means.begin(), means.end());
  operators.continuity_face = diagonal_matrix(Vector::Ones(mesh.face_count()));
  return operators;
}

/// The operators of rock without permeability: the only fluxes are those that are prescribed on sides.
FluxOperators no_flow(const Mesh& mesh, const std::vector<FlowCondition>& conditions) {
  FluxOperators operators;
  operators.flux_cell.resize(mesh.face_count(), mesh.cell_count());
  operators.trace_cell.resize(mesh.face_count(), mesh.cell_count());
  operators.trace_boundary.resize(mesh.face_count(), mesh.face_count());
  operators.flux_boundary.resize(mesh.face_count(), mesh.face_count());
  operators.flux_change.resize(mesh.face_count(), directions_of_faces * mesh.face_count());
  operators.trace_change.resize(mesh.face_count(), directions_of_faces * mesh.face_count());
  operators.blended_nodes.resize(mesh.face_count(), mesh.face_count());
  std::vector<Triplet> prescribed;
  for (int f = 0; f < mesh.face_count(); ++f)
    if (conditions[f] == FlowCondition::flux) prescribed.emplace_back(f, f, 1.0);
  operators.flux_boundary.setFromTriplets(prescribed.begin(), prescribed.end());
  return operators;
}

}  // namespace

void MatrixFlow::find_conditions() {
  conditions_.assign(mesh_.face_count(), FlowCondition::none);
  outer_faces_.clear();
  for (int f = 0; f < mesh_.face_count(); ++f) {
    if (mesh_.face_cells[f][1] != none) continue;
    conditions_[f] = FlowCondition::flux;
    if (mesh_.face_side[f] == none) continue;
    outer_faces_.emplace_back(f, mesh_.face_cells[f][0]);
    const auto condition = options_.boundary.find(mesh_.side_names[mesh_.face_side[f]]);
    if (!is_in_cell(mesh_.face_cells[f][0])) continue;
    if (condition != options_.boundary.end() && condition->second.pressure) conditions_[f] = FlowCondition::pressure;
  }
  open_conditions();
}

bool MatrixFlow::is_discretized() const {
  return discretized_mesh_ == mesh_.version && discretized_mobility_ == mobility_version_;
}

void MatrixFlow::discretize() {
  if (is_discretized()) return;
  find_conditions();
  if (is_sealed_) {
    operators_ = no_flow(mesh_, conditions_);
    if (face_pressure_) operators_.faces = means_on_faces(mesh_);
  } else if (!mobility_of_operators_.empty()) {
    return discretize_from({mesh_, mobility_of_operators_, conditions_}, operators_, no_change(mesh_));
  } else {
    std::vector<char> nodes = nodes_to_discretize(separated_ ? *separated_ : mesh_);
    // The face belongs to one of the processes that have the cells beside it, which needs the pressures of both.
    if (!nodes.empty())
      for (int f = 0; f < static_cast<int>(open_faces_.size()); ++f)
        if (open_faces_[f])
          for (const int node : separated_->face_nodes[f]) nodes[node] = 1;
    ++discretizations_;
    discretized_cells_ += inside_.empty() ? mesh_.cell_count() : std::count(inside_.begin(), inside_.end(), 1);
    discretized_regions_ += nodes.empty() ? mesh_.node_count() : std::count(nodes.begin(), nodes.end(), 1);
    FluxOperators made = separated_ ? discretize_inside(discretize_, {mesh_, mobility_, conditions_}, *separated_,
                                                        inside_, open_faces_, nodes)
                                    : discretize_(mesh_, mobility_, conditions_, nodes);
    operators_.swap(made);
  }
  use_operators();
}

void MatrixFlow::add_known_within_cells(const Field& field, KnownWithinCells& known) const {
  if (&field != &pressure_ || is_sealed_ || wall_pressure().constant.size() == 0) return;  // or no step has begun
  Vector at_walls = wall_pressure().accepted();
  exchange(mesh_, Location::wall, 1, at_walls);
  for (int wall = 0; wall < mesh_.wall_count(); ++wall)
    if (is_behind_wall(wall)) known.at_faces[mesh_.wall_face(wall)] = at_walls[wall];
}

void MatrixFlow::carry_over(const Part& part, const MeshChange& change) {
  if (history_) history_->history().hold(true);
  const MatrixFlow& before = dynamic_cast<const MatrixFlow&>(part);
  SPREKK_EXPECT(static_cast<int>(change.cell.size()) == mesh_.cell_count(), change.cell.size(), mesh_.cell_count());
  // What rock that remembers holds has been evaluated there as at the end of one more step.
  if (stores_by_state() && !change.is_at_start)
    uncounted_ = history_ ? Vector(Vector::Zero(mesh_.cell_count()))
                          : shared_in_cells(change, before.mesh_, before.stored_by_state());
  // With several processes, cells may have moved to other processes. Discretizations with unknowns on faces and limited
  // ones are local in cells, and done anew in no time.
  if (!keeps_operators() || by_state_ || parallel::size() > 1 || is_sealed_ || before.is_sealed_ ||
      !before.is_discretized())
    return;
  find_conditions();
  discretize_from({before.mesh_, before.mobility_, before.conditions_}, before.operators_, change);
}

void MatrixFlow::discretize_from(const FlowInputs& before, const FluxOperators& operators, const MeshChange& change) {
  Rediscretized result = rediscretize(discretize_, before, operators, {mesh_, mobility_, conditions_}, change);
  ++discretizations_;
  discretized_cells_ += result.cells;
  discretized_regions_ += result.regions;
  operators_.swap(result.operators);
  use_operators();
}

void MatrixFlow::use_operators() {
  discretized_mesh_ = mesh_.version;
  discretized_mobility_ = mobility_version_;
  mobility_of_operators_.clear();
  if (properties_change_ && !is_sealed_ && keeps_operators() && parallel::size() == 1)
    mobility_of_operators_ = mobility_;
  boundary_applied_ = false;
  ++operators_made_;
  forget_flow();
  const int rank = parallel::rank();
  // Flux through an inner face leaves one cell and enters another.
  std::vector<char> is_outer(mesh_.face_count());
  for (int f = 0; f < mesh_.face_count(); ++f) is_outer[f] = mesh_.face_cells[f][1] == none;
  const auto outflow_of = [&](const SparseMatrix& fluxes) {
    return Operator(cell_sums(mesh_, fluxes, 1, rank), cell_sums(mesh_, keep_rows(fluxes, is_outer), 1, rank));
  };
  outflow_of_pressure_ = outflow_of(operators_.flux_cell);
  SPREKK_ASSERT(operators_.flux_cell.rows() == mesh_.face_count(), operators_.flux_cell.rows(), mesh_.face_count());
  SPREKK_ASSERT(operators_.flux_cell.cols() == mesh_.cell_count(), operators_.flux_cell.cols(), mesh_.cell_count());
  SPREKK_ASSERT(operators_.flux_boundary.cols() == mesh_.face_count(), operators_.flux_boundary.cols());
  SPREKK_ASSERT(is_finite(operators_.flux_cell) && is_finite(operators_.flux_boundary));
  if (face_pressure_) outflow_of_face_pressure_ = outflow_of(operators_.faces.flux);
  largest_conductance_ = 0;
  const SparseMatrix& outflow = outflow_of_pressure_.entries();
  for (int row = 0; row < outflow.rows(); ++row) {
    double sum = outflow.row(row).cwiseAbs().sum();
    // In flat cells these are much larger, and cancel.
    if (face_pressure_) sum += outflow_of_face_pressure_.entries().row(row).cwiseAbs().sum();
    largest_conductance_ = std::max(largest_conductance_, sum);
  }
  if (is_limited_ && !is_sealed_) use_limited();
  if (!wall_flux_) {
    if (face_pressure_) use_face_operators();
    return use_borders();
  }

  // The flux out of the rock through a wall is −lambda times its length.
  boundary_of_wall_flux_ = outflow_of_wall_fluxes(mesh_);
  flux_of_wall_flux_ = operators_.flux_boundary * boundary_of_wall_flux_;
  outflow_of_wall_flux_ = outflow_of(flux_of_wall_flux_);
  if (is_limited_ && !is_sealed_)
    for (const int side : {0, 1})
      limited_of_wall_flux_[side] = operators_.limited[side].boundary * boundary_of_wall_flux_;

  const SparseMatrix pick_walls = owned_walls_of_faces(mesh_);
  wall_pressure_.terms = {{&pressure_, Operator(pick_walls * operators_.trace_cell)},
                          {wall_flux_, Operator(pick_walls * operators_.trace_boundary * boundary_of_wall_flux_)}};
  use_borders();
  for (const OpenBorder& border : borders_)
    wall_pressure_.terms.push_back(
        {border.outflow, Operator(pick_walls * operators_.trace_boundary * border.boundary)});
  if (!face_pressure_) return;
  wall_pressure_.terms.push_back({face_pressure_, Operator(pick_walls * operators_.faces.trace)});
  use_face_operators();
}

}  // namespace sprekk::matrix_flow
