#include "components/matrix_flow/rediscretize.hpp"

#include <cstring>

#include "components/matrix_flow/cells_read.hpp"
#include "framework/discretization/kept_regions.hpp"

namespace sprekk::matrix_flow {

Rediscretized rediscretize(Discretize discretize, const FlowInputs& before, const FluxOperators& operators,
                           const FlowInputs& after, const MeshChange& change) {
  const Adjacency cells_before = cells_read(before.mesh), cells_after = cells_read(after.mesh);
  const KeptRegions kept(
      {before.mesh, cells_before}, {after.mesh, cells_after}, change,
      [&](int cell, int was) {
        return std::memcmp(after.mobility[cell].data(), before.mobility[was].data(), sizeof(Tensor)) == 0;
      },
      [&](int face, int was) { return after.conditions[face] == before.conditions[was]; });
  FluxOperators result = discretize(after.mesh, after.mobility, after.conditions, kept.nodes_to_compute());
  constexpr auto face = KeptRegions::Entity::face, cell = KeptRegions::Entity::cell;
  result.flux_cell = kept.merge(operators.flux_cell, result.flux_cell, face, cell);
  result.flux_boundary = kept.merge(operators.flux_boundary, result.flux_boundary, face, face);
  result.flux_change = kept.merge(operators.flux_change, result.flux_change, face, face);
  result.trace_cell = kept.merge(operators.trace_cell, result.trace_cell, face, cell);
  result.trace_boundary = kept.merge(operators.trace_boundary, result.trace_boundary, face, face);
  result.trace_change = kept.merge(operators.trace_change, result.trace_change, face, face);
  result.blended_nodes = kept.merge(operators.blended_nodes, result.blended_nodes, face, face);
  return {std::move(result), kept.nodes_computed(), kept.cells_computed()};
}

}  // namespace sprekk::matrix_flow
