// The part of a discretization on interaction regions that stays, to the bit, when the mesh changes.
#pragma once

#include <functional>
#include <vector>

#include "framework/mesh/adjacency.hpp"
#include "framework/mesh/mesh_change.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// A mesh before or after the change, as a discretization sees it.
struct RegionInputs {
  const Mesh& mesh;
  const Adjacency& node_cells;  ///< the cells whose values and geometry a node's local problem reads, ascending
};

/// Finds the nodes whose local problems have the same inputs, bit by bit and in the same order, as on the mesh before:
/// positions of their corners, geometry of their cells and faces, which wall of which fracture cell a face is, and the
/// coefficients that the caller compares. A row of an operator is kept when all its nodes are such nodes; all other
/// rows are computed anew, from all their nodes. So the merged operator has the same bits as one that is computed as a
/// whole. All inputs are compared, so callers need not say what has changed.
class KeptRegions {
 public:
  using Compare = std::function<bool(int after, int before)>;
  /// `same_cell` and `same_face` compare coefficients of cells that the change maps, and conditions of faces.
  KeptRegions(const RegionInputs& before, const RegionInputs& after, const MeshChange& change, const Compare& same_cell,
              const Compare& same_face);

  /// For each node of the mesh after: whether its local problem is to be solved, because a row that it adds to is not
  /// kept.
  const std::vector<char>& nodes_to_compute() const { return nodes_to_compute_; }
  int nodes_computed() const;  ///< the number of nodes to compute
  int cells_computed() const;  ///< the number of cells that touch such a node

  /// The entities of the rows, or of the columns, of an operator.
  enum class Entity { cell, face };
  /// The operator on the mesh after. Kept rows come from `before`, with columns renumbered, all others from `after`,
  /// which has been computed at least at nodes_to_compute(). Rows and columns are entity-major, with any number of
  /// components.
  SparseMatrix merge(const SparseMatrix& before, const SparseMatrix& after, Entity rows, Entity columns) const;

 private:
  const std::vector<int>& kept(Entity entity) const { return entity == Entity::cell ? cell_rows_ : face_rows_; }

  const Mesh& mesh_;
  std::vector<int> cell_rows_, face_rows_;  ///< per entity after: the entity before whose rows are kept, or none
  std::vector<int> new_cell_, new_face_;    ///< per entity before: the same entity after, or none
  std::vector<char> nodes_to_compute_;
};

}  // namespace sprekk
