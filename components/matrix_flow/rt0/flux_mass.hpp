// The mass matrix of the fluxes through the faces of one cell: the lowest-order element of Raviart and Thomas.
#pragma once

#include <Eigen/Core>

#include "framework/mesh/mesh.hpp"

namespace sprekk::matrix_flow {

/// One row and one column for each face of a cell.
using FluxMass = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, 4, 4>;

/// M_ij = integral of v_i · mobility^-1 v_j over the cell, with v_i the element's velocity of unit flux out of face i
/// (cell_faces of the cell) and of none through the others; Pa s/m^2. The fluxes F of a cell (m^2/s) fulfil
/// M F = p − h, with p the mean pressure of the cell and h those of its faces (Arnold and Brezzi 1985). M is symmetric
/// and positive definite, and exact for constant velocities: M F = p − h where p is linear, at any tensor.
///
/// Triangles and parallelograms: Raviart and Thomas 1977, exactly. On other quadrilaterals the velocities that the
/// bilinear map gives (Piola) do not contain the constant ones. There, M takes the power of constant velocities from
/// its exact value, and only that of the other velocities from the map (an inner product of the mimetic finite
/// differences of Brezzi, Lipnikov and Simoncini, Math. Models Methods Appl. Sci. 15 (2005) 1533). For parallelograms
/// this is the same, so nothing jumps when a parallelogram is bent.
FluxMass flux_mass(const Mesh& mesh, int cell, const Tensor& mobility);

/// The same by quadrature that lumps it: diagonal in acute triangles and in rectangles whose sides are principal axes
/// of the mobility, angles in the metric of its inverse. In a triangle it is cot(angle opposite to the face)/2 over the
/// isotropic mobility (Baranger, Maitre and Oudin, RAIRO Modél. Math. Anal. Numér. 30 (1996) 445), and p is the
/// pressure at the centre of the circumcircle. In a quadrilateral, velocities are taken at the corners. `share`: how
/// much of the matrix is lumped; less than 1 in triangles with an angle near 90 degrees, 0 in obtuse ones: there the
/// lumped matrix would not be positive.
struct LumpedFluxMass {
  FluxMass mass;
  double share;
};
LumpedFluxMass lumped_flux_mass(const Mesh& mesh, int cell, const Tensor& mobility);

}  // namespace sprekk::matrix_flow
