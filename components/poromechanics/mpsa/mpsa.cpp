#include "components/poromechanics/mpsa/mpsa.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "components/poromechanics/mpsa/local_stresses.hpp"
#include "components/poromechanics/mpsa/tips.hpp"
#include "framework/discretization/interaction_region.hpp"
#include "framework/discretization/node_stencil.hpp"

namespace sprekk::poromechanics {

namespace {

bool has_load(const FaceConditions& conditions) {
  return std::ranges::count(conditions.along, MechanicalCondition::load) > 0;
}

void check_arguments(const Mesh& mesh, const std::vector<Stiffness>& stiffness,
                     const std::vector<FaceConditions>& conditions, const std::vector<char>& nodes) {
  if (static_cast<int>(stiffness.size()) != mesh.cell_count())
    throw std::invalid_argument("MPSA: one stiffness a cell is needed");
  if (static_cast<int>(conditions.size()) != mesh.face_count())
    throw std::invalid_argument("MPSA: one condition for each direction of a face is needed");
  if (!nodes.empty() && static_cast<int>(nodes.size()) != mesh.node_count())
    throw std::invalid_argument("MPSA: one flag a node is needed, or none at all");
  for (int face = 0; face < mesh.face_count(); ++face) {
    const bool is_loaded = has_load(conditions[face]);
    if (is_loaded && std::ranges::count(conditions[face].along, MechanicalCondition::load) < dimension)
      throw std::invalid_argument("MPSA: face " + std::to_string(face) + " is loaded in one direction only");
    for (const MechanicalCondition condition : conditions[face].along)
      if ((condition == MechanicalCondition::none || is_loaded) != (mesh.face_cells[face][1] != none))
        throw std::invalid_argument("MPSA: face " + std::to_string(face) +
                                    (condition == MechanicalCondition::none ? " has one cell and lacks a condition"
                                     : is_loaded                            ? " has one cell and a load"
                                                                            : " has two cells and a condition"));
    if (mesh.face_cells[face][1] != none && conditions[face].axes != ConditionAxes::of_space)
      throw std::invalid_argument("MPSA: face " + std::to_string(face) + " has two cells and axes of its own");
  }
}

/// The faces at every node that have boundary values: those with one cell, or with a load.
Adjacency faces_with_values(const Mesh& mesh, const std::vector<FaceConditions>& conditions) {
  Adjacency faces;
  faces.offsets.reserve(mesh.node_count() + 1);
  for (int node = 0; node < mesh.node_count(); ++node) {
    for (const int face : mesh.node_faces[node])
      if (conditions[face][0] != MechanicalCondition::none) faces.items.push_back(face);
    faces.offsets.push_back(static_cast<int>(faces.items.size()));
  }
  return faces;
}

/// The three matrices of one quantity: by displacement, isotropic stress and boundary value.
struct Coefficients {
  NodeStencil cells, valued;
  StencilMatrix displacement, stress, boundary;

  Coefficients(const Mesh& mesh, const Adjacency& row_nodes, const Adjacency& node_cells, const Adjacency& valued_faces,
               int components)
      : cells(row_nodes, node_cells),
        valued(row_nodes, valued_faces),
        displacement(cells, components, mesh.cell_count(), dimension),
        stress(cells, components, mesh.cell_count(), 1),
        boundary(valued, components, mesh.face_count(), dimension) {}

  void find_slots(int entity, int node) {
    cells.find_slots(entity, node, cell_slots_);
    valued.find_slots(entity, node, valued_slots_);
  }
  /// To be called for the entity and node that find_slots was called for last.
  void add(int entity, int component, const double* values, const LocalStresses& local, double factor) {
    displacement.add(entity, component, cell_slots_, values, factor);
    stress.add(entity, component, cell_slots_, values + local.stress_column(), factor);
    boundary.add(entity, component, valued_slots_, values + local.boundary_column(), factor);
  }
  void add_boundary(int entity, int component, int valued_index, double value) {
    boundary.add(entity, component, valued_slots_[valued_index], component, value);
  }

 private:
  std::vector<int> cell_slots_, valued_slots_;
};

}  // namespace

StressOperators discretize_mpsa(const Mesh& mesh, const std::vector<Stiffness>& stiffness,
                                const std::vector<FaceConditions>& conditions, const std::vector<char>& nodes,
                                const MpsaLimits& limits) {
  check_arguments(mesh, stiffness, conditions, nodes);
  const auto is_wanted = [&](int node) { return nodes.empty() || nodes[node]; };
  const auto any = [&](int, int node) { return is_wanted(node); };
  Tips tips(mesh, limits);
  const Adjacency node_cells = local_cells(mesh, tips), valued_faces = faces_with_values(mesh, conditions);
  Coefficients force(mesh, contributing_nodes(mesh.face_nodes, any), node_cells, valued_faces, dimension);
  Coefficients volume(mesh, contributing_nodes(mesh.cell_nodes, any), node_cells, valued_faces, 1);
  Coefficients trace(
      mesh,
      contributing_nodes(mesh.face_nodes,
                         [&](int face, int node) { return mesh.face_cells[face][1] == none && is_wanted(node); }),
      node_cells, valued_faces, dimension);

  InteractionRegion region;
  LocalStresses local(limits);
  std::vector<Triplet> moments;
  for (int node = 0; node < mesh.node_count(); ++node) {
    if (!is_wanted(node)) continue;
    region.assign(mesh, node);
    local.solve(mesh, region, node_cells[node], stiffness, conditions);
    tips.correct(node, region, node_cells[node], stiffness, local, moments);
    int valued_index = 0;
    for (int f = 0; f < region.subface_count(); ++f) {
      const int face = region.faces[f];
      force.find_slots(face, node);
      for (int c = 0; c < dimension; ++c) {
        // Prescribed values hold to the last digit, without the round-off of the local problem; along other axes the
        // local problem has them already.
        if (conditions[face][c] == MechanicalCondition::traction && conditions[face].axes == ConditionAxes::of_space &&
            !conditions[face].has_spring())
          force.add_boundary(face, c, valued_index, region.shares[f]);
        else
          force.add(face, c, local.force(f, c), local, 1);
      }
      if (conditions[face][0] != MechanicalCondition::none) ++valued_index;
      if (region.is_inner(f)) continue;
      trace.find_slots(face, node);
      for (int c = 0; c < dimension; ++c) trace.add(face, c, local.displacement(f, c), local, region.shares[f]);
    }
    for (int k = 0; k < region.subcell_count(); ++k) {
      const int cell = region.subcells[k].cell;
      volume.find_slots(cell, node);
      volume.add(cell, 0, local.volume_change(k), local, 1);
    }
  }
  SparseMatrix moment(symmetric_components * mesh.face_count(), dimension * mesh.cell_count());
  moment.setFromTriplets(moments.begin(), moments.end());
  return {force.displacement.take(), force.stress.take(),   force.boundary.take(),      trace.displacement.take(),
          trace.stress.take(),       trace.boundary.take(), volume.displacement.take(), volume.stress.take(),
          volume.boundary.take(),    std::move(moment)};
}

}  // namespace sprekk::poromechanics
