#include "components/poromechanics/mpsa/mpsa.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>

#include "components/poromechanics/mpsa/local_stresses.hpp"
#include "components/poromechanics/mpsa/tip_correction.hpp"
#include "framework/discretization/interaction_region.hpp"
#include "framework/discretization/node_stencil.hpp"
#include "framework/discretization/plane/end_zones.hpp"

namespace sprekk::poromechanics {

namespace {

bool has_load(const FaceConditions& conditions) {
  return conditions[0] == MechanicalCondition::load || conditions[1] == MechanicalCondition::load;
}

void check_arguments(const Mesh& mesh, const std::vector<Stiffness>& stiffness,
                     const std::vector<FaceConditions>& conditions, const std::vector<char>& nodes) {
  if (static_cast<int>(stiffness.size()) != mesh.cell_count())
    throw std::invalid_argument("MPSA: one stiffness a cell is needed");
  if (static_cast<int>(conditions.size()) != mesh.face_count())
    throw std::invalid_argument("MPSA: one pair of conditions a face is needed");
  if (!nodes.empty() && static_cast<int>(nodes.size()) != mesh.node_count())
    throw std::invalid_argument("MPSA: one flag a node is needed, or none at all");
  for (int face = 0; face < mesh.face_count(); ++face) {
    const bool is_loaded = has_load(conditions[face]);
    if (is_loaded && conditions[face][0] != conditions[face][1])
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
        displacement(cells, components, mesh.cell_count(), 2),
        stress(cells, components, mesh.cell_count(), 1),
        boundary(valued, components, mesh.face_count(), 2) {}

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

/// The fields of all tips, for the nodes near them.
class TipFields {
 public:
  TipFields(const Mesh& mesh, const std::vector<Stiffness>& stiffness, const EndZones& zones, const MpsaLimits& limits)
      : mesh_(mesh), stiffness_(stiffness), zones_(zones), limits_(limits) {}

  /// Null where there is none, or the rock is not like the tip's.
  const TipField* at(int node) {
    const int tip = zones_.end[node];
    if (tip == none) return nullptr;
    const auto [found, is_new] = fields_.try_emplace(tip);
    if (is_new) found->second = TipField::find(mesh_, tip, zones_.cells.at(tip), stiffness_, limits_);
    if (!found->second) return nullptr;
    for (const int cell : mesh_.node_cells[node])
      if (!resembles(stiffness_[cell], found->second->rock(), limits_.alike)) return nullptr;
    return &*found->second;
  }

 private:
  const Mesh& mesh_;
  const std::vector<Stiffness>& stiffness_;
  const EndZones& zones_;
  MpsaLimits limits_;
  std::map<int, std::optional<TipField>> fields_;
};

}  // namespace

StressOperators discretize_mpsa(const Mesh& mesh, const std::vector<Stiffness>& stiffness,
                                const std::vector<FaceConditions>& conditions, const std::vector<char>& nodes,
                                const MpsaLimits& limits) {
  check_arguments(mesh, stiffness, conditions, nodes);
  const auto is_wanted = [&](int node) { return nodes.empty() || nodes[node]; };
  const auto any = [&](int, int node) { return is_wanted(node); };
  const EndZones zones = end_zones(mesh, limits.zones);
  const Adjacency node_cells = local_cells(mesh, zones), valued_faces = faces_with_values(mesh, conditions);
  Coefficients force(mesh, contributing_nodes(mesh.face_nodes, any), node_cells, valued_faces, 2);
  Coefficients volume(mesh, contributing_nodes(mesh.cell_nodes, any), node_cells, valued_faces, 1);
  Coefficients trace(
      mesh,
      contributing_nodes(mesh.face_nodes,
                         [&](int face, int node) { return mesh.face_cells[face][1] == none && is_wanted(node); }),
      node_cells, valued_faces, 2);

  InteractionRegion region;
  LocalStresses local(limits);
  TipFields fields(mesh, stiffness, zones, limits);
  std::vector<Triplet> moments;
  for (int node = 0; node < mesh.node_count(); ++node) {
    if (!is_wanted(node)) continue;
    region.assign(mesh, node);
    local.solve(mesh, region, node_cells[node], stiffness, conditions);
    if (const TipField* tip = fields.at(node)) {
      const TipCorrection correction(*tip, zones.weight[node], mesh, region, node, node_cells[node], stiffness);
      local.correct(region, correction);
      // The moments of both halves about the centre of a face belong together: one alone is mostly that of its middle.
      for (int f = 0; f < region.subface_count(); ++f) {
        const auto& ends = mesh.face_nodes[region.faces[f]];
        if (region.is_inner(f) && fields.at(ends[ends[0] == node ? 1 : 0]) == tip)
          correction.add_moment(moments, f, std::min(zones.weight[ends[0]], zones.weight[ends[1]]));
      }
    }
    int valued_index = 0;
    for (int f = 0; f < region.subface_count(); ++f) {
      const int face = region.faces[f];
      force.find_slots(face, node);
      for (int c = 0; c < 2; ++c) {
        // Prescribed values hold to the last digit, without the round-off of the local problem; along other axes the
        // local problem has them already.
        if (conditions[face][c] == MechanicalCondition::traction && conditions[face].axes == ConditionAxes::of_space &&
            !conditions[face].has_spring())
          force.add_boundary(face, c, valued_index, 0.5);
        else
          force.add(face, c, local.force(f, c), local, 1);
      }
      if (conditions[face][0] != MechanicalCondition::none) ++valued_index;
      if (region.is_inner(f)) continue;
      trace.find_slots(face, node);
      for (int c = 0; c < 2; ++c) trace.add(face, c, local.displacement(f, c), local, 0.5);
    }
    for (int k = 0; k < region.subcell_count(); ++k) {
      const int cell = region.subcells[k].cell;
      volume.find_slots(cell, node);
      volume.add(cell, 0, local.volume_change(k), local, 1);
    }
  }
  SparseMatrix moment(3 * mesh.face_count(), 2 * mesh.cell_count());
  moment.setFromTriplets(moments.begin(), moments.end());
  return {force.displacement.take(), force.stress.take(),   force.boundary.take(),      trace.displacement.take(),
          trace.stress.take(),       trace.boundary.take(), volume.displacement.take(), volume.stress.take(),
          volume.boundary.take(),    std::move(moment)};
}

}  // namespace sprekk::poromechanics
