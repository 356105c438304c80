// The region around a node in which multi-point methods eliminate the unknowns on faces.
#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// The part of a cell next to the node, between the centres of the cell and of its faces there: as many as dimensions.
/// In a plane it is the quadrilateral of cell centre, face centre, node and the other face centre.
struct Subcell {
  int cell;
  std::array<int, dimension> subfaces;  ///< indices into InteractionRegion::faces
  /// grad v = sum_i gradient[i] (v at the continuity point of subface i - v at the centre), 1/m.
  std::array<Point, dimension> gradient;
  /// The normal out of the cell times the measure of the subface, m (m^2 in three dimensions).
  std::array<Point, dimension> half_face;
  double measure;  ///< m^2 (m^3 in three dimensions)
};

/// The subcells and subfaces around a node. A subface is the part of a face next to the node (share_at_node), with the
/// normal of the whole face. The values of both sides agree at the continuity point of a subface: in a plane a third of
/// the way from the centre of the face to the node (Klausen, Radu, Eigestad 2008), also on quadrilaterals, where
/// continuity_point has the centre; in space that of continuity_point. For a face with one cell the continuity point is
/// the centre of the face, so that values there are the values of a boundary face or wall.
struct InteractionRegion {
  std::vector<Subcell> subcells;  ///< in the order of Mesh::node_cells
  std::vector<int> faces;         ///< of the subfaces, in the order of Mesh::node_faces
  std::vector<double> shares;     ///< of the faces that the subfaces are (share_at_node)
  /// The subcells of each subface, as in Mesh::face_cells; none if there is no second.
  std::vector<std::array<int, 2>> neighbours;

  /// Describes the region around `node`. Keeps the storage of its former content.
  void assign(const Mesh& mesh, int node);

  int subcell_count() const { return static_cast<int>(subcells.size()); }
  int subface_count() const { return static_cast<int>(faces.size()); }
  bool is_inner(int subface) const { return neighbours[subface][1] != none; }
  /// The place of the subface within the given subcell, from 0.
  int place(int subface, int subcell) const {
    const auto& of_subcell = subcells[subcell].subfaces;
    int place = 0;
    while (place < dimension - 1 && of_subcell[place] != subface) ++place;
    return place;
  }
};

/// For every node, its faces with one cell, in ascending order.
Adjacency outer_faces_of_nodes(const Mesh& mesh);

/// The error of a method whose local problem in a region cannot be solved: where, how flat the cells are, and what to
/// do. `coefficient`: what else may be wrong, "stiffness".
std::runtime_error unsolvable_region(const std::string& method, const Mesh& mesh, const InteractionRegion& region,
                                     const std::string& coefficient);

}  // namespace sprekk
