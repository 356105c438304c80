// The mass matrix of the fluxes through the faces of one cell: the lowest-order element of Raviart and Thomas.
#pragma once

#include "components/matrix_flow/rt0/reference_mass.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::matrix_flow {

/// M_ij = integral of v_i · mobility^-1 v_j over the cell, with v_i the element's velocity of unit flux out of face i
/// (cell_faces of the cell) and of none through the others; Pa s/m^2 (Pa s/m^3 in three dimensions). The fluxes F of a
/// cell (m^2/s) fulfil M F = p − h, with p the mean pressure of the cell and h those of its faces (Arnold and Brezzi
/// 1985). M is symmetric and positive definite, and exact for constant velocities: M F = p − h where p is linear, at
/// any tensor.
///
/// Triangles, parallelograms, tetrahedra, parallelepipeds and right wedges: Raviart and Thomas 1977, Nédélec 1980,
/// exactly. On other quadrilaterals, wedges and hexahedra the velocities that the map from the reference cell gives
/// (Piola) do not contain the constant ones. There, M is exact for constant velocities, and only for the other
/// velocities it comes from the map (an inner product of the mimetic finite differences of Brezzi, Lipnikov and
/// Simoncini, Math. Models Methods Appl. Sci. 15 (2005) 1533). For parallelograms both agree, so M is continuous when a
/// parallelogram is bent. Where faces are bent, in space, the products of face centres and area vectors do not quite
/// add up to the volume, and M, which takes their inverse, is not quite symmetric. Throws std::runtime_error where they
/// are so bent that M would not be positive.
FluxMass flux_mass(const Mesh& mesh, int cell, const Tensor& mobility);

/// The same by quadrature that lumps it: diagonal in acute triangles and in rectangles whose sides are principal axes
/// of the mobility, angles in the metric of its inverse. In a triangle it is cot(angle opposite to the face)/2 over the
/// isotropic mobility (Baranger, Maitre and Oudin, RAIRO Modél. Math. Anal. Numér. 30 (1996) 445), and p is the
/// pressure at the centre of the circumcircle. In a quadrilateral or hexahedron, velocities are taken at the corners.
/// `share`: how much of the matrix is lumped; less than 1 in triangles with an angle near 90 degrees, 0 in obtuse ones:
/// there the lumped matrix would not be positive. Tetrahedra and wedges are not lumped.
LumpedFluxMass lumped_flux_mass(const Mesh& mesh, int cell, const Tensor& mobility);

/// The addition to flux_mass in steps that are short compared with the diffusion time of a cell. With M alone, some
/// entries of the conductances M^-1 have the wrong sign; if the cell stores much more than flows in a step, fluxes
/// through its other faces oppose the one that enters it (Hoteit, Mosé, Philippe, Ackerer and Erhel, Int. J. Numer.
/// Meth. Engng 55 (2002) 1373: below h^2/(6 D) in one dimension). The balance of the cell acts on its fluxes like an
/// addition dt/(S V) 1 1^T to M. A short step has too little of it, and the difference is added to M:
/// - triangles, tetrahedra, wedges: `added` = `until` 1 1^T, with the least number `until` for which M + added has an
///   inverse without positive entries off the diagonal; in triangles without obtuse angles that is the lumped matrix
///   except for the point of p. It does not exist from a right angle on, and is at most 3/(1^T M^-1 1)
///   (`most_resistance`).
/// - quadrilaterals, hexahedra: `added` completes M to the lumped matrix, `until` follows from pairs of opposite faces.
/// Both keep linear pressures exact, with p at the centre of the cell. In triangles, steady flow without sources is as
/// without it at any share.
struct MassForShortSteps {
  FluxMass added;
  double until;  ///< dt/(S V), Pa s/m^2, from which on nothing is added; 0 for never
};
/// The share of `added` in a step with this dt/(S V).
inline double share_for(double step, double until) { return step < until ? 1 - step / until : 0; }
MassForShortSteps mass_for_short_steps(const Mesh& mesh, int cell, const Tensor& mobility);

}  // namespace sprekk::matrix_flow
