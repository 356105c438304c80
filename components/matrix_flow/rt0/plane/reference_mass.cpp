#include "components/matrix_flow/rt0/reference_mass.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

namespace sprekk::matrix_flow {

/// Velocities of unit flux are (x − opposite corner)/(2 area). The products are of degree 2: the rule with the centres
/// of the faces is exact.
FluxMass mass_of_simplex(const Mesh& mesh, int cell, const Tensor& resistance) {
  const Ring& corners = mesh.cell_nodes[cell];
  const double area = mesh.cell_measure[cell];
  FluxMass mass = FluxMass::Zero(3, 3);
  for (const int face : mesh.cell_faces[cell]) {
    Eigen::Matrix<double, 2, 3> velocities;
    for (int k = 0; k < 3; ++k)
      velocities.col(k) = (mesh.face_center[face] - mesh.nodes[corners[(k + 2) % 3]]) / (2 * area);
    mass += area / 3 * velocities.transpose() * resistance * velocities;
  }
  return mass;
}

/// With the velocities that the bilinear map from the unit square gives, at two by two points that lie `offset` from
/// the middle of the square.
FluxMass mapped_mass(const Mesh& mesh, int cell, const Tensor& resistance, double offset) {
  std::array<Point, 4> x;
  for (int k = 0; k < 4; ++k) x[k] = mesh.nodes[mesh.cell_nodes[cell][k]];
  FluxMass mass = FluxMass::Zero(4, 4);
  for (const double s : {0.5 - offset, 0.5 + offset})
    for (const double t : {0.5 - offset, 0.5 + offset}) {
      Tensor jacobian;
      jacobian.col(0) = (1 - t) * (x[1] - x[0]) + t * (x[2] - x[3]);
      jacobian.col(1) = (1 - s) * (x[3] - x[0]) + s * (x[2] - x[1]);
      Eigen::Matrix<double, 2, 4> velocities;
      velocities << 0, s, 0, s - 1, t - 1, 0, t, 0;
      velocities = jacobian * velocities;
      mass += 1 / (4 * jacobian.determinant()) * velocities.transpose() * resistance * velocities;
    }
  return mass;
}

LumpedFluxMass lumped_mass_of_simplex(const Mesh& mesh, int cell, const Tensor& resistance) {
  // With e the edges from the corner opposite to a face, cot = e · resistance e' / (e × e' sqrt(det)), and the entry is
  // cot/2 times sqrt(det): for a resistance r I it is r cot/2.
  constexpr double least_cotangent = 0.1;
  FluxMass lumped = FluxMass::Zero(3, 3);
  double least = least_cotangent;
  const double root = std::sqrt(resistance.determinant());
  for (int k = 0; k < 3; ++k) {
    const Point& corner = mesh.nodes[mesh.cell_nodes[cell][(k + 2) % 3]];
    const Point one = mesh.nodes[mesh.cell_nodes[cell][k]] - corner;
    const Point two = mesh.nodes[mesh.cell_nodes[cell][(k + 1) % 3]] - corner;
    lumped(k, k) = one.dot(resistance * two) / (4 * mesh.cell_measure[cell]);
    least = std::min(least, 2 * lumped(k, k) / root);
  }
  const double share = std::max(0.0, least / least_cotangent);
  return {share * lumped + (1 - share) * mass_of_simplex(mesh, cell, resistance), share};
}

int opposite_face(int k) { return (k + 2) % 4; }

}  // namespace sprekk::matrix_flow
