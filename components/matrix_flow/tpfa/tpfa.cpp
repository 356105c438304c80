#include "components/matrix_flow/tpfa/tpfa.hpp"

#include <algorithm>

#include "components/matrix_flow/check_conditions.hpp"
#include "framework/discretization/changes_along_face.hpp"
#include "framework/invariants.hpp"
#include "framework/matrix_of.hpp"
#include "framework/round_off.hpp"

namespace sprekk::matrix_flow {

namespace {

/// Between the centre of the cell and that of its face, per pressure difference. This form equals the usual
/// |f| n·K d / |d|^2 where the latter is consistent (K n parallel to d), and is positive for every tensor.
double half_transmissibility(const Mesh& mesh, const Tensor& mobility, int cell, int face) {
  const Point& normal = mesh.face_normal[face];
  const double distance = std::abs(normal.dot(mesh.face_center[face] - mesh.cell_center[cell]));
  return mesh.face_measure[face] * normal.dot(mobility * normal) / distance;
}

/// Whether the flux of a linear pressure is exact between the centre of a cell and that of its face: K n is along them.
/// In a plane it is enough that K n is along n: that triangles are not orthogonal is no surprise, and errs less.
bool is_consistent(const Mesh& mesh, const Tensor& mobility, int cell, int face) {
  const Point& normal = mesh.face_normal[face];
  const Point conducted = mobility * normal;
  const Point way = dimension == 2 ? normal : Point(mesh.face_center[face] - mesh.cell_center[cell]);
  return (way - normal.dot(way) / normal.dot(conducted) * conducted).norm() <= rounding::far_above * way.norm();
}

}  // namespace

FluxOperators discretize_tpfa(const Mesh& mesh, const std::vector<Tensor>& mobility,
                              const std::vector<FlowCondition>& conditions, const std::vector<char>& nodes) {
  check_conditions(mesh, mobility, conditions, nodes);
  std::vector<Triplet> flux_cell, flux_boundary, trace_cell, trace_boundary, inexact;
  flux_cell.reserve(2 * mesh.face_count());
  for (int face = 0; face < mesh.face_count(); ++face) {
    const FaceNodes& ends = mesh.face_nodes[face];
    if (!nodes.empty() && !std::ranges::all_of(ends, [&](int node) { return nodes[node] != 0; })) continue;
    const auto [cell, other] = mesh.face_cells[face];
    const double half = half_transmissibility(mesh, mobility[cell], cell, face);
    SPREKK_ASSERT(half > 0, face, cell, half);
    SPREKK_ASSERT((conditions[face] == FlowCondition::none) == (other != none), face, other);
    if (conditions[face] != FlowCondition::flux &&
        !(is_consistent(mesh, mobility[cell], cell, face) &&
          (other == none || is_consistent(mesh, mobility[other], other, face))))
      inexact.emplace_back(face, face, 1);
    switch (conditions[face]) {
      case FlowCondition::none: {
        const double other_half = half_transmissibility(mesh, mobility[other], other, face);
        const double whole = half / (1 + half / other_half);
        flux_cell.emplace_back(face, cell, whole);
        flux_cell.emplace_back(face, other, -whole);
        break;
      }
      case FlowCondition::pressure:
        flux_cell.emplace_back(face, cell, half);
        flux_boundary.emplace_back(face, face, -half);
        trace_boundary.emplace_back(face, face, 1);
        break;
      case FlowCondition::flux:
        flux_boundary.emplace_back(face, face, 1);
        trace_cell.emplace_back(face, cell, 1);
        trace_boundary.emplace_back(face, face, -1 / half);
        break;
    }
  }
  const auto assemble = [&](const std::vector<Triplet>& entries, int columns) {
    return matrix_of(mesh.face_count(), columns, entries);
  };
  const auto nothing = [&](int columns) { return SparseMatrix(mesh.face_count(), columns * mesh.face_count()); };
  return {assemble(flux_cell, mesh.cell_count()),
          assemble(flux_boundary, mesh.face_count()),
          nothing(directions_of_faces),
          assemble(trace_cell, mesh.cell_count()),
          assemble(trace_boundary, mesh.face_count()),
          nothing(directions_of_faces),
          assemble(inexact, mesh.face_count())};
}

std::vector<FluxDerivatives> differentiate_tpfa(const FlowInputs& flow, const std::vector<char>& nodes,
                                                const FluxState& state, const std::vector<std::vector<Tensor>>& by) {
  const auto& [mesh, mobility, conditions] = flow;
  FluxDerivativeEntries entries(by.size());
  for (int face = 0; face < mesh.face_count(); ++face) {
    const FaceNodes& ends = mesh.face_nodes[face];
    if (!nodes.empty() && !std::ranges::all_of(ends, [&](int node) { return nodes[node] != 0; })) continue;
    const auto [cell, other] = mesh.face_cells[face];
    const double half = half_transmissibility(mesh, mobility[cell], cell, face), given = state.boundary[face];
    for (std::size_t variable = 0; variable < by.size(); ++variable) {
      const auto change = [&](int of) { return half_transmissibility(mesh, by[variable][of], of, face); };
      if (conditions[face] == FlowCondition::flux) {
        entries.add_to_trace(variable, face, cell, given / (half * half) * change(cell));
      } else if (conditions[face] == FlowCondition::pressure) {
        entries.add_to_flux(variable, face, cell, (state.cells[cell] - given) * change(cell));
      } else {
        const double other_half = half_transmissibility(mesh, mobility[other], other, face);
        const double part = other_half / (half + other_half), drop = state.cells[cell] - state.cells[other];
        entries.add_to_flux(variable, face, cell, part * part * drop * change(cell));
        entries.add_to_flux(variable, face, other, (1 - part) * (1 - part) * drop * change(other));
      }
    }
  }
  return entries.take(mesh);
}

}  // namespace sprekk::matrix_flow
