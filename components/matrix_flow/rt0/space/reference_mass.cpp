#include "components/matrix_flow/rt0/reference_mass.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

namespace sprekk::matrix_flow {
namespace {

/// A point of a reference cell: where it lies, what part of the cell it stands for, and there the derivatives of the
/// map and the velocities of unit flux out of each face.
struct Sample {
  double part;
  Tensor jacobian;
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 6> velocities;
};

/// Of a unit cube.
Sample in_cube(const std::array<Point, 8>& x, double s, double t, double z) {
  Sample at{1.0 / 8, {}, Eigen::Matrix<double, 3, 6>::Zero()};
  const auto across = [&](int bottom, double a, double b) {  // between edges of the bottom and of the top
    const auto edge = [&](int from, int to) { return Point(x[to] - x[from]); };
    const bool is_s = bottom == 0;
    const Point low =
        is_s ? Point((1 - a) * edge(0, 1) + a * edge(3, 2)) : Point((1 - a) * edge(0, 3) + a * edge(1, 2));
    const Point high =
        is_s ? Point((1 - a) * edge(4, 5) + a * edge(7, 6)) : Point((1 - a) * edge(4, 7) + a * edge(5, 6));
    return Point((1 - b) * low + b * high);
  };
  at.jacobian.col(0) = across(0, t, z);
  at.jacobian.col(1) = across(1, s, z);
  at.jacobian.col(2) =
      (1 - t) * ((1 - s) * (x[4] - x[0]) + s * (x[5] - x[1])) + t * ((1 - s) * (x[7] - x[3]) + s * (x[6] - x[2]));
  at.velocities(2, 0) = z - 1;
  at.velocities(2, 1) = z;
  at.velocities(1, 2) = t - 1;
  at.velocities(0, 3) = s;
  at.velocities(1, 4) = t;
  at.velocities(0, 5) = s - 1;
  return at;
}

/// Of a wedge of height 1 above the triangle (0, 0), (1, 0), (0, 1).
Sample in_wedge(const std::array<Point, 8>& x, double s, double t, double z) {
  Sample at{1.0 / 12, {}, Eigen::Matrix<double, 3, 5>::Zero()};
  const auto at_height = [&](int k) { return Point((1 - z) * x[k] + z * x[k + 3]); };
  at.jacobian.col(0) = at_height(1) - at_height(0);
  at.jacobian.col(1) = at_height(2) - at_height(0);
  at.jacobian.col(2) = (1 - s - t) * (x[3] - x[0]) + s * (x[4] - x[1]) + t * (x[5] - x[2]);
  at.velocities.col(0) = Point(0, 0, 2 * (z - 1));
  at.velocities.col(1) = Point(0, 0, 2 * z);
  at.velocities.col(2) = Point(s, t - 1, 0);
  at.velocities.col(3) = Point(s, t, 0);
  at.velocities.col(4) = Point(s - 1, t, 0);
  return at;
}

void add_to(FluxMass& mass, const Sample& at, const Tensor& resistance) {
  const Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 6> velocities = at.jacobian * at.velocities;
  mass += at.part / at.jacobian.determinant() * velocities.transpose() * resistance * velocities;
}

}  // namespace

/// Velocities of unit flux are (x − opposite corner)/(3 volume). Their products are of degree 2; the second moments of
/// a tetrahedron are the sum over corners of volume/20 (corner − centre)(corner − centre)^T.
FluxMass mass_of_simplex(const Mesh& mesh, int cell, const Tensor& resistance) {
  const CellNodes& corners = mesh.cell_nodes[cell];
  const Point& center = mesh.cell_center[cell];
  const double volume = mesh.cell_measure[cell];
  double spread = 0;
  for (const int corner : corners) {
    const Point away = mesh.nodes[corner] - center;
    spread += away.dot(resistance * away) / 20;
  }
  Eigen::Matrix<double, 3, 4> velocities;
  for (int k = 0; k < 4; ++k) {
    // Opposite to a face is the corner that is none of its nodes: three times farther from the centre.
    velocities.col(k) = (mesh.face_center[mesh.cell_faces[cell][k]] - center) / volume;
  }
  FluxMass mass = volume * velocities.transpose() * resistance * velocities;
  mass.array() += spread / (9 * volume);
  return mass;
}

FluxMass mapped_mass(const Mesh& mesh, int cell, const Tensor& resistance, double offset) {
  const CellNodes& corners = mesh.cell_nodes[cell];
  std::array<Point, 8> x;
  for (int k = 0; k < corners.size(); ++k) x[k] = mesh.nodes[corners[k]];
  const int faces = mesh.cell_faces[cell].size();
  FluxMass mass = FluxMass::Zero(faces, faces);
  const std::array<double, 2> along{0.5 - offset, 0.5 + offset};
  for (const double z : along) {
    if (corners.size() == 6) {
      for (const auto& [s, t] : {std::pair{0.5, 0.0}, {0.5, 0.5}, {0.0, 0.5}})
        add_to(mass, in_wedge(x, s, t, z), resistance);
      continue;
    }
    for (const double s : along)
      for (const double t : along) add_to(mass, in_cube(x, s, t, z), resistance);
  }
  return mass;
}

LumpedFluxMass lumped_mass_of_simplex(const Mesh& mesh, int cell, const Tensor& resistance) {
  return {mass_of_simplex(mesh, cell, resistance), 0};
}

int opposite_face(int k) { return std::array<int, 6>{1, 0, 4, 5, 2, 3}[k]; }

}  // namespace sprekk::matrix_flow
