// The functions of a cell from which displacements are made.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "components/poromechanics/fem/cell_edges.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::poromechanics {

/// A point of a cell's integrals. The functions, in this order:
/// - corner k: linear (bilinear, trilinear), 1 at the corner and 0 at the others;
/// - edge k, where there are functions of edges: 1 in its middle, 0 on the other edges and at corners, of second order
///   along the edge, linear across it;
/// - face k: 1 in the middle of the face, 0 on the other faces and at corners, of second order along the face; in space
///   0 on edges, too, and cubic along triangles. Its coefficient is how much more the middle is displaced than by
///   the functions before.
/// - interior (1 function): 1 in the middle of the cell and 0 on its faces; the product of the shares in all corners in
///   triangles and tetrahedra, of second order in each coordinate in quadrilaterals and hexahedra, both in wedges.
/// Those of corners and of faces in a plane, or edges in space, contain every polynomial of second order on triangles
/// and tetrahedra; all together, on other shapes, every one in the coordinates of the reference cell.
struct CellPoint {
  using Gradients = Eigen::Matrix<double, dimension, Eigen::Dynamic>;
  Point x;                ///< m
  double weight;          ///< m^2 (m^3 in space)
  Eigen::VectorXd value;  ///< of each function
  Gradients gradient;     ///< 1/m, a column for each function
};

/// The points of a cell: integrals of products of gradients are exact where the sides of the cell are parallel, or it
/// is a triangle or a tetrahedron. `tips`: see
/// tips_of_faces; empty where the middle nodes of all faces are in the middle. `edges`: in space, those with functions.
std::vector<CellPoint> cell_points(const Mesh& mesh, int cell, const std::vector<int>& tips = {},
                                   const CellEdges* edges = nullptr);

}  // namespace sprekk::poromechanics
