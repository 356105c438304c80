// The parts of a face next to its nodes, in which multi-point methods take fluxes.
#pragma once

#include <array>
#include <cmath>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// The share of a face that is next to one of its nodes: a half in a plane, a third of a triangle; of a quadrilateral
/// what lies between the node, the middles of its edges there and the mean of its nodes, as seen along its normal. The
/// shares of a face add up to 1.
double share_in_space(const Mesh& mesh, int face, int node);
inline double share_at_node(const Mesh& mesh, int face, int node) {
  if constexpr (dimension == 2) {
    return 0.5;
  } else {
    return share_in_space(mesh, face, node);
  }
}

/// Where the values of both sides of a face agree near one of its nodes: at centre + part · way. With the arms from the
/// centre of a cell to these points dual to its area vectors at the node, fluxes are symmetric in drops of the
/// potential, and positive, for any tensor (Klausen, Radu and Eigestad, Int. J. Numer. Meth. Fluids 58 (2008) 1327).
/// This holds for all cells named below except for `other`; the mean of the points, by the shares, is the centre.
///   edge of a triangle, in a plane: a third of the way to the node;
///   face of a tetrahedron: a quarter of the way to the node;
///   quadrilateral of a wedge with parallel edges: a third of the way to the edge between the wedge's triangles;
///   edge of a parallelogram, face of a parallelepiped, triangle of such a wedge, other: the centre.
/// A face between cells of different kinds has the point of the first kind here that is beside it.
struct ContinuityPoint {
  Point way;    ///< from the centre of the face to the node, or to the middle of the edge, m
  double part;  ///< 0 to 1
};
ContinuityPoint continuity_point_in_space(const Mesh& mesh, int face, int node);
inline ContinuityPoint continuity_point(const Mesh& mesh, int face, int node) {
  if constexpr (dimension == 2) {
    const auto [first, second] = mesh.face_cells[face];
    const bool has_triangle =
        mesh.cell_nodes[first].size() == 3 || (second != none && mesh.cell_nodes[second].size() == 3);
    return {mesh.nodes[node] - mesh.face_center[face], has_triangle ? 1.0 / 3 : 0};
  } else {
    return continuity_point_in_space(mesh, face, node);
  }
}

/// Ways along a face, m: in a plane from its centre to the node, in space another one of this length across it, too.
std::array<Point, dimension - 1> ways_along_face(const Mesh& mesh, int face, int node);

/// The measure of the part of a cell next to a node, m^2 (m^3 in three dimensions). In a plane between the centre, the
/// node and the centres of both faces there; in space between the centre and the area vectors at the node (`subfaces`,
/// out of the cell), so that the parts of a cell with flat faces add up to it.
inline double subcell_measure(const Point& center, const Point& node, const std::array<Point, dimension>& face_centers,
                              const std::array<Point, dimension>& subfaces) {
  if constexpr (dimension == 2) {
    const Point to_node = node - center, across = face_centers[1] - face_centers[0];
    return 0.5 * std::abs(to_node[0] * across[1] - to_node[1] * across[0]);
  } else {
    double measure = 0;
    for (int i = 0; i < dimension; ++i) measure += subfaces[i].dot(face_centers[i] - center) / dimension;
    return measure;
  }
}

}  // namespace sprekk
