// The region around a node in which multi-point methods eliminate the unknowns on faces.
#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// The part of a cell next to the node: the quadrilateral of cell centre, face centre, node and the other face centre.
struct Subcell {
  int cell;
  std::array<int, 2> subfaces;  ///< indices into InteractionRegion::faces
  std::array<Point, 2>
      gradient;  ///< grad v = sum_i gradient[i] (v at the continuity point of subface i - v at the centre), 1/m
  std::array<Point, 2> half_face;  ///< normal out of the cell times half of the face's length, m
  double area;                     ///< m^2
};

/// The subcells and subfaces around a node. A subface is the half of a face next to the node. The values of both sides
/// agree at the continuity point of a subface, a third of the way from the centre of the face to the node (Klausen,
/// Radu, Eigestad 2008). For a face with one cell the continuity point is the centre of the face, so that values there
/// are the values of a boundary face or wall.
struct InteractionRegion {
  std::vector<Subcell> subcells;  ///< in the order of Mesh::node_cells
  std::vector<int> faces;         ///< of the subfaces, in the order of Mesh::node_faces
  std::vector<std::array<int, 2>>
      neighbours;  ///< subcells of each subface, as in Mesh::face_cells; none if there is no second

  /// Describes the region around `node`. Keeps the storage of its former content.
  void assign(const Mesh& mesh, int node);

  int subcell_count() const { return static_cast<int>(subcells.size()); }
  int subface_count() const { return static_cast<int>(faces.size()); }
  bool is_inner(int subface) const { return neighbours[subface][1] != none; }
  /// The place of the subface within the given subcell, 0 or 1.
  int place(int subface, int subcell) const { return subcells[subcell].subfaces[0] == subface ? 0 : 1; }
};

/// For every node, its faces with one cell, in ascending order.
Adjacency outer_faces_of_nodes(const Mesh& mesh);

/// The error of a method whose local problem in a region cannot be solved: where, how flat the cells are, and what to
/// do. `coefficient`: what else may be wrong, "stiffness".
std::runtime_error unsolvable_region(const std::string& method, const Mesh& mesh, const InteractionRegion& region,
                                     const std::string& coefficient);

}  // namespace sprekk
