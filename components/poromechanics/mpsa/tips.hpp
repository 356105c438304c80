// What the tips of fractures change in local problems.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "components/poromechanics/mpsa/limits.hpp"
#include "components/poromechanics/mpsa/local_stresses.hpp"
#include "components/poromechanics/stiffness.hpp"
#include "framework/discretization/interaction_region.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::poromechanics {

/// In a plane the displacement is like sqrt(r) around a tip, by the displacements of all cells around it (TipField,
/// TipCorrection), in a zone around it (EndZones). In space displacements are taken to be linear there as elsewhere.
class Tips {
 public:
  /// The mesh outlives the tips.
  explicit Tips(const Mesh& mesh, const MpsaLimits& limits = {});

  /// The cells from whose displacements the field around a node follows, ascending; none where it has none.
  std::span<const int> cells_near(int node) const;
  /// Whether the same field counts as much here as at another node of another mesh.
  bool has_same_zone(int node, const Tips& other, int node_of_other) const;
  /// Adds the field to a local problem that is solved; `moments`: of StressOperators::moment_displacement.
  void correct(int node, const InteractionRegion& region, std::span<const int> cells,
               const std::vector<Stiffness>& stiffness, LocalStresses& local, std::vector<Triplet>& moments);

 private:
  struct Content;
  std::shared_ptr<Content> content_;
};

/// For each node, the cells whose displacements and stresses its local problem reads, in ascending order: the cells at
/// the node. For a node with few cells also cells beyond their faces (add_cells_beyond), and near a tip also the cells
/// from which its field is found.
Adjacency local_cells(const Mesh& mesh, const Tips& tips);

}  // namespace sprekk::poromechanics
