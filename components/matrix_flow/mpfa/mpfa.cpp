#include "components/matrix_flow/mpfa/mpfa.hpp"

#include <algorithm>
#include <utility>

#include "components/matrix_flow/check_conditions.hpp"
#include "components/matrix_flow/mpfa/local_fluxes.hpp"
#include "components/matrix_flow/mpfa/tips.hpp"
#include "framework/discretization/changes_along_face.hpp"
#include "framework/discretization/interaction_region.hpp"
#include "framework/discretization/node_stencil.hpp"
#include "framework/invariants.hpp"

namespace sprekk::matrix_flow {
namespace {

/// The faces of every node at which the pressure is prescribed, in ascending order.
Adjacency pressure_faces_of_nodes(const Mesh& mesh, const std::vector<FlowCondition>& conditions) {
  Adjacency faces;
  faces.offsets.reserve(mesh.node_count() + 1);
  for (int node = 0; node < mesh.node_count(); ++node) {
    for (const int face : mesh.node_faces[node])
      if (conditions[face] == FlowCondition::pressure) faces.items.push_back(face);
    faces.offsets.push_back(static_cast<int>(faces.items.size()));
  }
  return faces;
}

/// Coefficients with respect to the changes of prescribed pressures along their faces, from those with respect to the
/// pressures at the continuity points.
class ChangeColumns {
 public:
  void assign(const Mesh& mesh, int node, const InteractionRegion& region, const LocalFluxes& local,
              const std::vector<FlowCondition>& conditions) {
    columns_.clear();
    int column = region.subcell_count();
    for (int f = 0; f < region.subface_count(); ++f) {
      if (region.is_inner(f)) continue;
      const int face = region.faces[f];
      if (conditions[face] == FlowCondition::pressure)
        for (const double along : position_along_face(mesh, face, node, local.point(f)))
          columns_.emplace_back(column, along);
      ++column;
    }
    values_.resize(columns_.size());
  }

  const double* of(const double* local) {
    for (std::size_t i = 0; i < columns_.size(); ++i) values_[i] = columns_[i].second * local[columns_[i].first];
    return values_.data();
  }

 private:
  std::vector<std::pair<int, double>> columns_;  ///< columns of the local problem, and positions along the face
  std::vector<double> values_;
};

}  // namespace

FluxOperators discretize_mpfa(const Mesh& mesh, const std::vector<Tensor>& mobility,
                              const std::vector<FlowCondition>& conditions, const std::vector<char>& nodes) {
  return discretize_mpfa_with({}, mesh, mobility, conditions, nodes);
}

FluxOperators discretize_mpfa_with(const MpfaLimits& limits, const Mesh& mesh, const std::vector<Tensor>& mobility,
                                   const std::vector<FlowCondition>& conditions, const std::vector<char>& nodes) {
  check_conditions(mesh, mobility, conditions, nodes);
  SPREKK_EXPECT(static_cast<int>(mobility.size()) == mesh.cell_count(), mobility.size(), mesh.cell_count());
  SPREKK_EXPECT(static_cast<int>(conditions.size()) == mesh.face_count(), conditions.size(), mesh.face_count());
  SPREKK_EXPECT(nodes.empty() || static_cast<int>(nodes.size()) == mesh.node_count(), nodes.size(), mesh.node_count());
  SPREKK_EXPECT(std::ranges::all_of(mobility, [](const Tensor& m) { return m.allFinite(); }));
  const auto is_wanted = [&](int node) { return nodes.empty() || nodes[node]; };
  const Adjacency all = contributing_nodes(mesh.face_nodes, [&](int, int node) { return is_wanted(node); });
  const Adjacency outer = contributing_nodes(
      mesh.face_nodes, [&](int face, int node) { return mesh.face_cells[face][1] == none && is_wanted(node); });
  Tips tips(limits, mesh, mobility, conditions, nodes);
  const Adjacency& node_cells = tips.cells_of_nodes();
  const Adjacency outer_faces = outer_faces_of_nodes(mesh);
  const NodeStencil face_cells(all, node_cells), face_outer(all, outer_faces);
  const NodeStencil outer_cells(outer, node_cells), outer_outer(outer, outer_faces);
  const Adjacency pressure_faces = pressure_faces_of_nodes(mesh, conditions);
  const NodeStencil face_changes(all, pressure_faces), outer_changes(outer, pressure_faces);
  StencilMatrix flux_cell(face_cells, 1, mesh.cell_count(), 1), flux_boundary(face_outer, 1, mesh.face_count(), 1);
  StencilMatrix trace_cell(outer_cells, 1, mesh.cell_count(), 1), trace_boundary(outer_outer, 1, mesh.face_count(), 1);
  StencilMatrix flux_change(face_changes, 1, mesh.face_count(), directions_of_faces),
      trace_change(outer_changes, 1, mesh.face_count(), directions_of_faces);

  InteractionRegion region;
  LocalFluxes local;
  ChangeColumns changes;
  std::vector<int> cell_slots, outer_slots, change_slots;
  std::vector<Triplet> blended;
  for (int node = 0; node < mesh.node_count(); ++node) {
    if (!is_wanted(node)) continue;
    region.assign(mesh, node);
    SPREKK_ASSERT(region.subcell_count() > 0, node);
    SPREKK_ASSERT(are_indices(region.faces, mesh.face_count()), node);
    if (local.solve(mesh, node, region, mobility, conditions) == LocalFluxes::Stabilizer::blend)
      for (const int face : region.faces) blended.emplace_back(face, face, 1.0 / region.subface_count());
    changes.assign(mesh, node, region, local, conditions);
    tips.assign(node, region, local);
    int outer_index = 0;
    for (int f = 0; f < region.subface_count(); ++f) {
      const int face = region.faces[f];
      face_outer.find_slots(face, node, outer_slots);
      if (conditions[face] == FlowCondition::flux) {
        flux_boundary.add(face, 0, outer_slots[outer_index], 0, region.shares[f]);
      } else {
        face_cells.find_slots(face, node, cell_slots);
        flux_cell.add(face, 0, cell_slots, tips.flux(f), 1);
        flux_boundary.add(face, 0, outer_slots, local.flux(f) + region.subcell_count(), 1);
        face_changes.find_slots(face, node, change_slots);
        flux_change.add(face, 0, change_slots, changes.of(local.flux(f)), 1);
      }
      if (region.is_inner(f)) continue;
      ++outer_index;
      outer_cells.find_slots(face, node, cell_slots);
      outer_outer.find_slots(face, node, outer_slots);
      trace_cell.add(face, 0, cell_slots, tips.pressure(f), region.shares[f]);
      trace_boundary.add(face, 0, outer_slots, local.pressure(f) + region.subcell_count(), region.shares[f]);
      outer_changes.find_slots(face, node, change_slots);
      trace_change.add(face, 0, change_slots, changes.of(local.pressure(f)), region.shares[f]);
    }
  }
  SparseMatrix blended_nodes(mesh.face_count(), mesh.face_count());
  blended_nodes.setFromTriplets(blended.begin(), blended.end());
  return {flux_cell.take(),      flux_boundary.take(), flux_change.take(),      trace_cell.take(),
          trace_boundary.take(), trace_change.take(),  std::move(blended_nodes)};
}

}  // namespace sprekk::matrix_flow
