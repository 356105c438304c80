#include "components/matrix_flow/mpfa/mpfa.hpp"

#include "components/matrix_flow/check_conditions.hpp"
#include "components/matrix_flow/mpfa/local_fluxes.hpp"
#include "framework/mesh/interaction_region.hpp"
#include "framework/mesh/node_stencil.hpp"

namespace sprekk::matrix_flow {

FluxOperators discretize_mpfa(const Mesh& mesh, const std::vector<Tensor>& mobility,
                              const std::vector<FlowCondition>& conditions, const std::vector<char>& nodes) {
  check_conditions(mesh, mobility, conditions, nodes);
  const auto is_wanted = [&](int node) { return nodes.empty() || nodes[node]; };
  const Adjacency all = contributing_nodes(mesh.face_nodes, [&](int, int node) { return is_wanted(node); });
  const Adjacency outer = contributing_nodes(
      mesh.face_nodes, [&](int face, int node) { return mesh.face_cells[face][1] == none && is_wanted(node); });
  const Adjacency outer_faces = outer_faces_of_nodes(mesh);
  const NodeStencil face_cells(all, mesh.node_cells), face_outer(all, outer_faces);
  const NodeStencil outer_cells(outer, mesh.node_cells), outer_outer(outer, outer_faces);
  StencilMatrix flux_cell(face_cells, 1, mesh.cell_count(), 1), flux_boundary(face_outer, 1, mesh.face_count(), 1);
  StencilMatrix trace_cell(outer_cells, 1, mesh.cell_count(), 1), trace_boundary(outer_outer, 1, mesh.face_count(), 1);

  InteractionRegion region;
  LocalFluxes local;
  std::vector<int> cell_slots, outer_slots;
  for (int node = 0; node < mesh.node_count(); ++node) {
    if (!is_wanted(node)) continue;
    region.assign(mesh, node);
    local.solve(region, mobility, conditions);
    int outer_index = 0;
    for (int f = 0; f < region.subface_count(); ++f) {
      const int face = region.faces[f];
      face_outer.find_slots(face, node, outer_slots);
      if (conditions[face] == FlowCondition::flux) {
        flux_boundary.add(face, 0, outer_slots[outer_index], 0, 0.5);
      } else {
        face_cells.find_slots(face, node, cell_slots);
        flux_cell.add(face, 0, cell_slots, local.flux(f), 1);
        flux_boundary.add(face, 0, outer_slots, local.flux(f) + region.subcell_count(), 1);
      }
      if (region.is_inner(f)) continue;
      ++outer_index;
      outer_cells.find_slots(face, node, cell_slots);
      outer_outer.find_slots(face, node, outer_slots);
      trace_cell.add(face, 0, cell_slots, local.pressure(f), 0.5);
      trace_boundary.add(face, 0, outer_slots, local.pressure(f) + region.subcell_count(), 0.5);
    }
  }
  return {flux_cell.take(), flux_boundary.take(), trace_cell.take(), trace_boundary.take()};
}

}  // namespace sprekk::matrix_flow
