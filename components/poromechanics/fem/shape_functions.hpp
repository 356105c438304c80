// The functions of a cell from which displacements are made.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk::poromechanics {

/// A point of a cell's integrals. The functions, in this order, for a cell with m corners:
/// - corner k (m functions): linear or bilinear, 1 at the corner and 0 at the others;
/// - face k (m functions): 1 in the middle of the face, 0 on the other faces and at corners, of second order along the
///   face. Its coefficient is how much more the middle is displaced than the mean of the ends.
/// - interior (1 function): 1 in the middle of the cell and 0 on its faces; cubic in triangles, of second order in each
///   coordinate in quadrilaterals.
/// All together they contain every polynomial of second order on triangles, and on quadrilaterals every one in the
/// coordinates of the reference square.
struct CellPoint {
  Point x;                                                    ///< m
  double weight;                                              ///< m^2
  Eigen::VectorXd value;                                      ///< 2 m + 1
  Eigen::Matrix<double, dimension, Eigen::Dynamic> gradient;  ///< 1/m, a column for each function
};

/// The points of a cell: integrals of products of gradients are exact in triangles and parallelograms. `tips`: see
/// tips_of_faces; empty where the middle nodes of all faces are in the middle.
std::vector<CellPoint> cell_points(const Mesh& mesh, int cell, const std::vector<int>& tips = {});

/// The mean over a face of its own function, wherever its middle node is. Of those of its ends: means_of_ends.
inline constexpr double mean_of_face = 2.0 / 3;

}  // namespace sprekk::poromechanics
