// What of a discretization on interaction regions stays, to the bit, when the mesh changes.
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

/// Finds the nodes whose local problems have, bit by bit and in the same order, the inputs that they had on the mesh
/// before: positions of their corners, geometry of their cells and faces, which wall of which fracture cell a face is,
/// and whatever coefficients the caller compares. A row of an operator is kept when all its nodes are; all other rows
/// are computed anew, from all their nodes. So an operator that is put together from both has the bits of one that is
/// computed as a whole. It need not be known what has changed: everything that is read is compared.
class KeptRegions {
 public:
  using Compare = std::function<bool(int after, int before)>;
  /// `same_cell` and `same_face` compare coefficients of cells that the change maps, and conditions of faces.
  KeptRegions(const RegionInputs& before, const RegionInputs& after, const MeshChange& change, const Compare& same_cell,
              const Compare& same_face);

  /// One flag a node of the mesh after: its local problem is to be solved, since a row that it adds to is not kept.
  const std::vector<char>& nodes_to_compute() const { return nodes_to_compute_; }
  int nodes_computed() const;  ///< how many these are
  int cells_computed() const;  ///< cells that touch such a node

  enum class Entity { cell, face };
  /// The operator on the mesh after: kept rows from the one `before`, with columns renumbered, the others from `after`,
  /// which has been computed at nodes_to_compute() at least. Rows and columns are entity-major, any number of
  /// components.
  SparseMatrix merge(const SparseMatrix& before, const SparseMatrix& after, Entity rows, Entity columns) const;

 private:
  const std::vector<int>& kept(Entity entity) const { return entity == Entity::cell ? cell_rows_ : face_rows_; }

  const Mesh& mesh_;
  std::vector<int> cell_rows_, face_rows_;  ///< per entity after: the one before whose rows it keeps, or none
  std::vector<int> new_cell_, new_face_;    ///< per entity before: the one after, or none
  std::vector<char> nodes_to_compute_;
};

}  // namespace sprekk
