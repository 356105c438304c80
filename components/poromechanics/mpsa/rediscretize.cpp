#include "components/poromechanics/mpsa/rediscretize.hpp"

#include <cstring>

#include "components/poromechanics/mpsa/mpsa.hpp"
#include "components/poromechanics/mpsa/tips.hpp"
#include "framework/discretization/kept_regions.hpp"

namespace sprekk::poromechanics {

Rediscretized rediscretize_mpsa(const StressInputs& before, const StressOperators& operators, const StressInputs& after,
                                const MeshChange& change) {
  const Tips tips_before(before.mesh), tips_after(after.mesh);
  const Adjacency cells_before = local_cells(before.mesh, tips_before),
                  cells_after = local_cells(after.mesh, tips_after);
  const KeptRegions kept(
      {before.mesh, cells_before}, {after.mesh, cells_after}, change,
      [&](int cell, int was) {
        return std::memcmp(after.stiffness[cell].data(), before.stiffness[was].data(), sizeof(Stiffness)) == 0;
      },
      [&](int face, int was) {
        const FaceNodes &nodes = after.mesh.face_nodes[face], &old_nodes = before.mesh.face_nodes[was];
        bool is_same = after.conditions[face] == before.conditions[was];
        for (int k = 0; is_same && k < static_cast<int>(nodes.size()); ++k)
          is_same = tips_after.has_same_zone(nodes[k], tips_before, old_nodes[k]);
        return is_same;
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
