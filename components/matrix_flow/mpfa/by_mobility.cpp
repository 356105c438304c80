#include "components/matrix_flow/mpfa/by_mobility.hpp"

#include <algorithm>

#include "components/matrix_flow/mpfa/local_fluxes.hpp"
#include "framework/discretization/changes_along_face.hpp"
#include "framework/invariants.hpp"

namespace sprekk::matrix_flow {
namespace {

/// The values of the columns of a local problem.
void find_given(const Mesh& mesh, int node, const InteractionRegion& region, const LocalFluxes& local,
                const std::vector<FlowCondition>& conditions, const FluxState& state, std::vector<double>& given) {
  given.clear();
  for (const Subcell& subcell : region.subcells) given.push_back(state.cells[subcell.cell]);
  for (int f = 0; f < region.subface_count(); ++f) {
    if (region.is_inner(f)) continue;
    const int face = region.faces[f];
    double value = state.boundary[face];
    if (conditions[face] == FlowCondition::pressure) {
      const AlongFace along = position_along_face(mesh, face, node, local.point(f));
      for (int k = 0; k < directions_of_faces; ++k) value += along[k] * state.changes[directions_of_faces * face + k];
    }
    given.push_back(value);
  }
}

}  // namespace

std::vector<FluxDerivatives> differentiate_mpfa(const FlowInputs& flow, const std::vector<char>& nodes,
                                                const FluxState& state, const std::vector<std::vector<Tensor>>& by) {
  const auto& [mesh, mobility, conditions] = flow;
  SPREKK_EXPECT(state.cells.size() == mesh.cell_count(), state.cells.size(), mesh.cell_count());
  SPREKK_EXPECT(state.boundary.size() == mesh.face_count(), state.boundary.size(), mesh.face_count());
  FluxDerivativeEntries entries(by.size());
  InteractionRegion region;
  LocalFluxes local(LocalFluxes::Derivatives::by_mobility);
  LocalFluxes::Change change;
  std::vector<double> given;
  for (int node = 0; node < mesh.node_count(); ++node) {
    if (!nodes.empty() && !nodes[node]) continue;
    region.assign(mesh, node);
    const auto is_constant = [&](const Subcell& subcell) {
      return std::ranges::all_of(by, [&](const auto& of_cells) { return of_cells[subcell.cell].isZero(0); });
    };
    if (std::ranges::all_of(region.subcells, is_constant)) continue;
    local.solve(mesh, node, region, mobility, conditions);
    find_given(mesh, node, region, local, conditions, state, given);
    for (int k = 0; k < region.subcell_count(); ++k) {
      const int cell = region.subcells[k].cell;
      for (std::size_t variable = 0; variable < by.size(); ++variable) {
        const Tensor& of_cell = by[variable][cell];
        if (of_cell.isZero(0)) continue;
        local.by_mobility(region, conditions, k, of_cell, given, change);
        for (int f = 0; f < region.subface_count(); ++f) {
          entries.add_to_flux(variable, region.faces[f], cell, change.flux[f]);
          if (!region.is_inner(f))
            entries.add_to_trace(variable, region.faces[f], cell, region.shares[f] * change.pressure[f]);
        }
      }
    }
  }
  return entries.take(mesh);
}

}  // namespace sprekk::matrix_flow
