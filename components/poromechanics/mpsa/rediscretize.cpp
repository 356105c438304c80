#include "components/poromechanics/mpsa/rediscretize.hpp"

#include <cstring>

#include "components/poromechanics/mpsa/local_stresses.hpp"
#include "components/poromechanics/mpsa/mpsa.hpp"
#include "framework/discretization/kept_regions.hpp"
#include "framework/discretization/plane/end_zones.hpp"

namespace sprekk::poromechanics {

Rediscretized rediscretize_mpsa(const StressInputs& before, const StressOperators& operators, const StressInputs& after,
                                const MeshChange& change) {
  const EndZones zones_before = end_zones(before.mesh), zones_after = end_zones(after.mesh);
  const Adjacency cells_before = local_cells(before.mesh, zones_before),
                  cells_after = local_cells(after.mesh, zones_after);
  const auto has_same_zone = [&](int node, int was) {
    const int tip = zones_after.end[node], old_tip = zones_before.end[was];
    if (tip == none || old_tip == none) return tip == old_tip;
    return zones_after.weight[node] == zones_before.weight[was] && after.mesh.nodes[tip] == before.mesh.nodes[old_tip];
  };
  const KeptRegions kept(
      {before.mesh, cells_before}, {after.mesh, cells_after}, change,
      [&](int cell, int was) {
        return std::memcmp(after.stiffness[cell].data(), before.stiffness[was].data(), sizeof(Stiffness)) == 0;
      },
      [&](int face, int was) {
        const auto &nodes = after.mesh.face_nodes[face], &old_nodes = before.mesh.face_nodes[was];
        return after.conditions[face] == before.conditions[was] && has_same_zone(nodes[0], old_nodes[0]) &&
               has_same_zone(nodes[1], old_nodes[1]);
      });
  StressOperators result = discretize_mpsa(after.mesh, after.stiffness, after.conditions, kept.nodes_to_compute());
  const auto take_kept = [&](SparseMatrix StressOperators::*matrix, KeptRegions::Entity rows,
                             KeptRegions::Entity columns) {
    result.*matrix = kept.merge(operators.*matrix, result.*matrix, rows, columns);
  };
  constexpr auto face = KeptRegions::Entity::face, cell = KeptRegions::Entity::cell;
  take_kept(&StressOperators::force_displacement, face, cell);
  take_kept(&StressOperators::force_stress, face, cell);
  take_kept(&StressOperators::force_boundary, face, face);
  take_kept(&StressOperators::trace_displacement, face, cell);
  take_kept(&StressOperators::trace_stress, face, cell);
  take_kept(&StressOperators::trace_boundary, face, face);
  take_kept(&StressOperators::volume_displacement, cell, cell);
  take_kept(&StressOperators::volume_stress, cell, cell);
  take_kept(&StressOperators::volume_boundary, cell, face);
  take_kept(&StressOperators::moment_displacement, face, cell);
  return {std::move(result), kept.nodes_computed(), kept.cells_computed()};
}

}  // namespace sprekk::poromechanics
