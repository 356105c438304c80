// The surroundings of a node in which multi-point methods eliminate what lives on the faces.
#pragma once

#include <array>
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

/// A subface is the half of a face next to the node. Its continuity point, at which the values of both sides agree,
/// lies a third of the way from the face's centre to the node, and in the centre itself for a face with one cell
/// (Klausen, Radu, Eigestad 2008): so a value at it is the value at the centre of a boundary face or wall.
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

/// The faces with one cell at every node, in ascending order.
Adjacency outer_faces_of_nodes(const Mesh& mesh);

}  // namespace sprekk
