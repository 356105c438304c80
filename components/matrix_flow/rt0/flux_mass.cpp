#include "components/matrix_flow/rt0/flux_mass.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "framework/invariants.hpp"

namespace sprekk::matrix_flow {
namespace {

/// Velocities of unit flux are (x − opposite corner)/(2 area). The products are of degree 2: the rule with the centres
/// of the faces is exact.
FluxMass mass_of_triangle(const Mesh& mesh, int cell, const Tensor& resistance) {
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

constexpr double of_gauss = std::numbers::sqrt3 / 6;
constexpr double of_corners = 0.5;

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

FluxMass mass_of_quadrilateral(const Mesh& mesh, int cell, const Tensor& mobility, const Tensor& resistance,
                               double offset) {
  // The constant velocity mobility·g has the fluxes N g, and its pressure falls by R g from the centre of the cell to
  // those of the faces.
  Eigen::Matrix<double, 4, 2> fluxes, drops;
  for (int k = 0; k < 4; ++k) {
    const int face = mesh.cell_faces[cell][k];
    const double out = mesh.face_cells[face][0] == cell ? 1 : -1;
    fluxes.row(k) = out * mesh.face_measure[face] * (mobility * mesh.face_normal[face]).transpose();
    drops.row(k) = (mesh.face_center[face] - mesh.cell_center[cell]).transpose();
  }
  const Tensor inverse = resistance / mesh.cell_measure[cell];  // of R^T N, by the divergence theorem
  const Eigen::Matrix4d others = Eigen::Matrix4d::Identity() - fluxes * inverse * drops.transpose();
  return drops * inverse * drops.transpose() +
         others.transpose() * mapped_mass(mesh, cell, resistance, offset) * others;
}

}  // namespace

FluxMass flux_mass(const Mesh& mesh, int cell, const Tensor& mobility) {
  const int faces = static_cast<int>(mesh.cell_faces[cell].size());
  SPREKK_EXPECT(faces == 3 || faces == 4, cell, faces);
  const Tensor resistance = mobility.inverse();
  SPREKK_EXPECT(resistance.allFinite(), cell);
  return faces == 3 ? mass_of_triangle(mesh, cell, resistance)
                    : mass_of_quadrilateral(mesh, cell, mobility, resistance, of_gauss);
}

LumpedFluxMass lumped_flux_mass(const Mesh& mesh, int cell, const Tensor& mobility) {
  const Tensor resistance = mobility.inverse();
  if (mesh.cell_faces[cell].size() == 4)
    return {mass_of_quadrilateral(mesh, cell, mobility, resistance, of_corners), 1};
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
  return {share * lumped + (1 - share) * mass_of_triangle(mesh, cell, resistance), share};
}

MassForShortSteps mass_for_short_steps(const Mesh& mesh, int cell, const Tensor& mobility) {
  const FluxMass mass = flux_mass(mesh, cell, mobility);
  if (mass.rows() == 4) {
    const FluxMass added = lumped_flux_mass(mesh, cell, mobility).mass - mass;
    double until = 0;
    for (int k = 0; k < 2; ++k)  // 1 1^T is 4 for the sum of two faces
      until = std::max(until, (added(k, k) + added(k + 2, k + 2) + 2 * added(k, k + 2)) / 4);
    return {added, until};
  }
  // With A = M^-1 and a = A 1: the inverse of M + x 1 1^T is A − x a a^T/(1 + x sum a).
  constexpr double most_resistance = 3;  // x sum a
  const FluxMass conductance = mass.inverse();
  const Eigen::Vector3d of_cell = conductance.rowwise().sum();
  double resistance = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const double positive = conductance(i, j) * of_cell.sum(), exchanged = of_cell[i] * of_cell[j];
    if (positive <= 0) continue;
    const bool is_enough = (1 + most_resistance) * positive <= most_resistance * exchanged;
    resistance = std::max(resistance, is_enough ? positive / (exchanged - positive) : most_resistance);
  }
  const double until = resistance / of_cell.sum();
  return {FluxMass::Constant(3, 3, until), until};
}

}  // namespace sprekk::matrix_flow
