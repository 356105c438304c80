// Shape functions of quadratic triangles and edges.
#pragma once

#include <Eigen/LU>
#include <array>

#include "components/fine_fracture/quarter_point/mesh/fine_mesh.hpp"

namespace sprekk::fine_fracture {

/// The shape functions at a place in an element.
struct ShapePoint {
  Point x;                               ///< m
  double jacobian;                       ///< dA / (dxi deta), m^2
  Eigen::Matrix<double, 6, 1> value;     ///< of the six nodes
  Eigen::Matrix<double, 6, 2> gradient;  ///< d/dx, d/dy, 1/m
};

/// The shape functions at the place (xi, eta) of the unit triangle, whose corners (0, 0), (1, 0), (0, 1) are the nodes
/// 0, 1, 2. Not defined at the tip of a quarter-point element, where gradients are infinite.
inline ShapePoint shape_point(const FineMesh& mesh, const FineMesh::Element& element, double xi, double eta) {
  const double zeta = 1 - xi - eta;
  ShapePoint p;
  p.value << zeta * (2 * zeta - 1), xi * (2 * xi - 1), eta * (2 * eta - 1), 4 * zeta * xi, 4 * xi * eta, 4 * eta * zeta;
  Eigen::Matrix<double, 6, 2> local;
  local << 1 - 4 * zeta, 1 - 4 * zeta,  //
      4 * xi - 1, 0,                    //
      0, 4 * eta - 1,                   //
      4 * (zeta - xi), -4 * xi,         //
      4 * eta, 4 * xi,                  //
      -4 * eta, 4 * (zeta - eta);
  p.x.setZero();
  Tensor derivative = Tensor::Zero();  // dx_i / dxi_j
  for (int k = 0; k < 6; ++k) {
    const Point& node = mesh.nodes[element.nodes[k]];
    p.x += p.value[k] * node;
    derivative += node * local.row(k);
  }
  p.jacobian = derivative.determinant();
  p.gradient = local * derivative.inverse();
  return p;
}

/// The quadratic shape functions at a place on an edge.
struct EdgePoint {
  Point x;
  double jacobian;              ///< ds / dt, m
  std::array<double, 3> value;  ///< of from, to, middle
};

/// At the parameter t of the edge, 0 at its first node and 1 at its second one.
inline EdgePoint edge_point(const FineMesh& mesh, const EdgeNodes& nodes, double t) {
  EdgePoint p;
  p.value = {(1 - t) * (1 - 2 * t), t * (2 * t - 1), 4 * t * (1 - t)};
  const std::array<double, 3> derivative = {4 * t - 3, 4 * t - 1, 4 - 8 * t};
  p.x.setZero();
  Point along = Point::Zero();
  for (int k = 0; k < 3; ++k) {
    p.x += p.value[k] * mesh.nodes[nodes[k]];
    along += derivative[k] * mesh.nodes[nodes[k]];
  }
  p.jacobian = along.norm();
  return p;
}

}  // namespace sprekk::fine_fracture
