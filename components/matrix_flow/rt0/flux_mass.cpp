#include "components/matrix_flow/rt0/flux_mass.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "framework/invariants.hpp"
#include "framework/mesh/geometry.hpp"

namespace sprekk::matrix_flow {
namespace {

constexpr double of_gauss = std::numbers::sqrt3 / 6;
constexpr double of_corners = 0.5;

/// (drops^T fluxes)^-1 of the constant velocities: resistance / measure by the divergence theorem; in a cell whose
/// faces are bent, in space, this is not quite so.
template <class Matrix>
Tensor inverse_of_constants(const Mesh& mesh, int cell, const Tensor& resistance, const Matrix& drops,
                            const Matrix& fluxes) {
  if constexpr (dimension == 2) return resistance / mesh.cell_measure[cell];
  const Tensor product = drops.transpose() * fluxes, inverse = product.inverse();
  if (Eigen::LLT<Tensor>(inverse + inverse.transpose()).info() != Eigen::Success)
    throw std::runtime_error("flux discretization: the faces of a cell at " + to_text(mesh.cell_center[cell]) +
                             " are too bent for the anisotropy of its mobility");
  return inverse;
}

template <int faces>
FluxMass completed_mass(const Mesh& mesh, int cell, const Tensor& mobility, const Tensor& resistance, double offset) {
  // The constant velocity mobility·g has the fluxes N g, and its pressure falls by R g from the centre of the cell to
  // those of the faces.
  Eigen::Matrix<double, faces, dimension> fluxes, drops;
  for (int k = 0; k < faces; ++k) {
    const int face = mesh.cell_faces[cell][k];
    const double out = mesh.face_cells[face][0] == cell ? 1 : -1;
    fluxes.row(k) = out * mesh.face_measure[face] * (mobility * mesh.face_normal[face]).transpose();
    drops.row(k) = (mesh.face_center[face] - mesh.cell_center[cell]).transpose();
  }
  const Tensor inverse = inverse_of_constants(mesh, cell, resistance, drops, fluxes);
  const Eigen::Matrix<double, faces, faces> others =
      Eigen::Matrix<double, faces, faces>::Identity() - fluxes * inverse * drops.transpose();
  return drops * inverse * drops.transpose() +
         others.transpose() * mapped_mass(mesh, cell, resistance, offset) * others;
}

bool is_simplex(const Mesh& mesh, int cell) { return mesh.cell_nodes[cell].size() == dimension + 1; }
bool is_wedge(const Mesh& mesh, int cell) { return mesh.cell_faces[cell].size() == 5; }

/// Of a cell that is no simplex.
FluxMass mass_of(const Mesh& mesh, int cell, const Tensor& mobility, const Tensor& resistance, double offset) {
  if constexpr (dimension == 2) return completed_mass<4>(mesh, cell, mobility, resistance, offset);
  return is_wedge(mesh, cell) ? completed_mass<5>(mesh, cell, mobility, resistance, offset)
                              : completed_mass<6>(mesh, cell, mobility, resistance, offset);
}

/// The least resistance x with which the inverse of M + x 1 1^T has no positive entries off the diagonal.
template <int faces>
double least_added(const FluxMass& mass) {
  // With A = M^-1 and a = A 1: the inverse of M + x 1 1^T is A − x a a^T/(1 + x sum a).
  constexpr double most_resistance = 3;  // x sum a
  const FluxMass conductance = mass.inverse();
  const Eigen::Matrix<double, faces, 1> of_cell = conductance.rowwise().sum();
  double resistance = 0;
  for (int i = 0; i < faces; ++i)
    for (int j = 0; j < faces; ++j) {
      // In a plane symmetric: one of both entries.
      if (i == j || (dimension == 2 && j != (i + 1) % faces)) continue;
      const double positive = conductance(i, j) * of_cell.sum(), exchanged = of_cell[i] * of_cell[j];
      if (positive <= 0) continue;
      const bool is_enough = (1 + most_resistance) * positive <= most_resistance * exchanged;
      resistance = std::max(resistance, is_enough ? positive / (exchanged - positive) : most_resistance);
    }
  return resistance / of_cell.sum();
}

}  // namespace

FluxMass flux_mass(const Mesh& mesh, int cell, const Tensor& mobility) {
  const Tensor resistance = mobility.inverse();
  SPREKK_EXPECT(resistance.allFinite(), cell);
  return is_simplex(mesh, cell) ? mass_of_simplex(mesh, cell, resistance)
                                : mass_of(mesh, cell, mobility, resistance, of_gauss);
}

LumpedFluxMass lumped_flux_mass(const Mesh& mesh, int cell, const Tensor& mobility) {
  const Tensor resistance = mobility.inverse();
  if (is_simplex(mesh, cell)) return lumped_mass_of_simplex(mesh, cell, resistance);
  const bool is_lumped = !is_wedge(mesh, cell);
  return {mass_of(mesh, cell, mobility, resistance, is_lumped ? of_corners : of_gauss), is_lumped ? 1.0 : 0.0};
}

MassForShortSteps mass_for_short_steps(const Mesh& mesh, int cell, const Tensor& mobility) {
  const FluxMass mass = flux_mass(mesh, cell, mobility);
  if (!is_simplex(mesh, cell) && !is_wedge(mesh, cell)) {
    const FluxMass added = lumped_flux_mass(mesh, cell, mobility).mass - mass;
    double until = 0;
    for (int k = 0; k < mass.rows(); ++k) {
      const int other = opposite_face(k);
      if (other < k) continue;  // 1 1^T is 4 for the sum of two faces
      until = std::max(until, (added(k, k) + added(other, other) + 2 * added(k, other)) / 4);
    }
    return {added, until};
  }
  const double until = is_wedge(mesh, cell) ? least_added<5>(mass) : least_added<dimension + 1>(mass);
  return {FluxMass::Constant(mass.rows(), mass.cols(), until), until};
}

}  // namespace sprekk::matrix_flow
