// The record of a change of the mesh.
#pragma once

#include <vector>

#include "framework/mesh/mesh.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// A part of a fracture cell that has been replaced, by the way along the fracture.
struct ReplacedPart {
  int cell;       ///< the new fracture cell in whose place the part is
  int old_cell;   ///< the fracture cell of the old mesh that it was in
  double share;   ///< of the old cell's length, above 0; all parts of an old cell add up to 1
  double length;  ///< m, of the part
};

/// Maps the entities of a new mesh to those of the old mesh; `none` stands for new entities.
struct MeshChange {
  /// Per new cell: the old cell with the same corners in the same order, so that local face k is the same one, too.
  std::vector<int> cell;
  /// Per new face: the old face with the same end points (and on a wall: on the same side of the same fracture cell).
  std::vector<int> face;
  std::vector<int> fracture_cell;  ///< per new fracture cell: the same old cell; none where the fracture has grown
                                   ///< or cells have been replaced
  std::vector<int> ridge;          ///< per new ridge: the same old ridge
  /// New cells x old cells: the area of their intersection, m^2; for kept cells their area on the one entry. Rows sum
  /// to the new cells' areas, columns to the old cells' (to rounding). Eq. 17 of the paper divides the rows by their
  /// sums.
  SparseMatrix overlap;
  std::vector<int> new_cells;      ///< those with cell[i] == none, ascending
  std::vector<int> removed_cells;  ///< the old cells that no longer exist, ascending
  /// Where fracture cells have been replaced by others, along the way from the last point that was kept.
  std::vector<ReplacedPart> replaced_parts;
  /// Whether all fractures keep their places: the change makes other cells, and nothing else.
  bool is_at_rest = false;
  /// Whether the mesh changes before the first step: the state is then the initial one of the scene.
  bool is_at_start = false;
};

/// Per new fracture cell: the part of its length that replaced cells covered: 1 for kept cells, 0 where rock parts.
Vector covered_parts(const MeshChange& change, const Mesh& after);

/// Amounts of old cells, or of old fracture cells, among the new ones: those that are kept have their own, others the
/// shares of what they cover. Rock that parts has none. A cell may have several amounts (components).
Vector shared_in_cells(const MeshChange& change, const Mesh& before, const Vector& amounts, int components = 1);
Vector shared_in_fracture_cells(const MeshChange& change, const Vector& amounts);

/// The change that keeps every cell, face, fracture cell and ridge; its overlap is empty.
MeshChange no_change(const Mesh& mesh);

}  // namespace sprekk
