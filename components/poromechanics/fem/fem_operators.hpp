// The linear equations of finite elements on a whole mesh.
#pragma once

#include <vector>

#include "components/poromechanics/fem/cell_stiffness.hpp"
#include "components/poromechanics/fem/held_directions.hpp"
#include "components/poromechanics/fem/raw_displacement.hpp"
#include "components/poromechanics/fem/springs.hpp"
#include "components/poromechanics/fem/tips_of_faces.hpp"
#include "components/poromechanics/stiffness.hpp"

namespace sprekk::poromechanics {

/// A quantity as a linear function of
/// - u, the unknowns: displacements of every node, m; at second order then those of every edge, in space, and of every
///   face, m; at first order, with a volumetric stress, then that of every cell, Pa;
/// - s, the isotropic stress of every cell, Pa (sigma = C : grad u − s I);
/// - T, the traction on the plus wall of every fracture cell, Pa, (normal, tangential); opposite on the minus wall;
/// - F, the forces on all coefficients of the displacement (RawDisplacement), N/m (N in space);
/// - g, the displacements that are prescribed along axes of nodes and faces (HeldDirections), m, in the same numbering.
struct LinearInFem {
  SparseMatrix of_displacement, of_stress, of_traction, of_force, of_given;
};

/// What the equations of the rock need.
struct FemOperators {
  /// A row for each unknown: stiffness · u − forces, N/m (N in space); rows that are held are k (u − g). With a
  /// volumetric stress q of cells q + taken · (mean of div u), Pa.
  LinearInFem momentum;
  LinearInFem all;         ///< all coefficients of the displacement, m
  SparseMatrix volume;     ///< div u integrated over every cell, of all coefficients, m^2 (m^3 in space)
  SparseMatrix jump;       ///< mean of u(minus) − u(plus) over every fracture cell, (normal, tangential), of all, m
  Vector wall_compliance;  ///< how a traction on walls moves the functions of their faces alone, m/Pa, as `jump`
  std::vector<CellPoint::Gradients> of_interior;  ///< see CellStiffness
  std::vector<int> tips;                          ///< see tips_of_faces
  SparseMatrix to_rows;  ///< from forces on all coefficients to the rows of unknowns; 0 for prescribed displacements
  std::vector<Eigen::MatrixXd> of_cells;  ///< of second order: CellStiffness::of_unknowns of each cell
};

/// Assembles the stiffness of a mesh. At second order every coefficient is an unknown, and `raw` has edges in space. At
/// first order those of faces are functions of the others, which stabilizes cellwise s and T: the residual forces on
/// the function of a face, those of s, T and F among them, displace it as if it stood alone (FacesTogether). Its
/// stiffness is made larger until it is at least that of all functions of faces of a cell together, so that what is
/// left for the nodes is positive definite (Rodrigo, Hu, Ohm, Adler, Gaspar and Zikatanov 2018, New stabilized
/// discretizations for poroelasticity and the Stokes' equations, with the whole vector in place of its normal
/// component). In cells that are no triangles or tetrahedra it is twice as stiff: else the functions of faces could
/// take all of the stiffness of a cell that bends, and with twice it they leave half of it. Nothing is displaced where
/// displacements are linear and tractions agree, and what leaves one cell through a face enters the other.
///
/// Cells at tips are those of second order at either order, with their field of a tip (tips_of_faces). At first order
/// the functions of all their faces are displaced together, as elimination would do it, so that the nodes remain the
/// only unknowns.
///
/// `has_volumetric_stress`, at first order: the stress with which nearly incompressible cells resist a change of volume
/// (see VolumetricSplit) is an unknown of its own, which acts as s does.
///
/// `springs`: on sides; they count as a part of the stiffness of their cells.
FemOperators fem_operators(const RawDisplacement& raw, const std::vector<Stiffness>& stiffness, const Held& held,
                           ElementOrder order, bool has_volumetric_stress = false, const Springs& springs = {});

}  // namespace sprekk::poromechanics
