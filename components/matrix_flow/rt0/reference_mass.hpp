// Mass matrices of fluxes by the velocities of reference cells.
#pragma once

#include <Eigen/Core>

#include "framework/mesh/mesh.hpp"

namespace sprekk::matrix_flow {

inline constexpr int most_faces = 2 * dimension;  ///< of a cell
/// One row and one column for each face of a cell.
using FluxMass = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, most_faces, most_faces>;

/// A mass matrix, and how much of it is lumped (lumped_flux_mass): 0 to 1.
struct LumpedFluxMass {
  FluxMass mass;
  double share;
};

/// The mass matrix of a triangle or a tetrahedron, exactly: the velocities of unit flux are linear and contain the
/// constant ones.
/// `resistance`: mobility^-1, Pa s/m^2.
FluxMass mass_of_simplex(const Mesh& mesh, int cell, const Tensor& resistance);

/// The mass matrix of another cell, with velocities that are mapped from its reference cell (a square, a cube or a
/// right wedge) by Piola's transform. `offset`: the distance of the points of quadrature from the middle of the
/// reference cell, along each edge of a square or cube and along the height of a wedge.
FluxMass mapped_mass(const Mesh& mesh, int cell, const Tensor& resistance, double offset);

/// See lumped_flux_mass.
LumpedFluxMass lumped_mass_of_simplex(const Mesh& mesh, int cell, const Tensor& resistance);

/// Faces k and opposite_face(k) of a quadrilateral or a hexahedron are opposite.
int opposite_face(int k);

}  // namespace sprekk::matrix_flow
