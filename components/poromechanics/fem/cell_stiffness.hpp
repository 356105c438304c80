// The forces of one cell as a linear function of its displacements.
#pragma once

#include <Eigen/Core>

#include "components/poromechanics/fem/shape_functions.hpp"
#include "components/poromechanics/stiffness.hpp"

namespace sprekk::poromechanics {

/// The order of finite elements.
enum class ElementOrder { first = 1, second = 2 };

/// The stiffness of one cell, N/m per m (N/m in space). Unknowns are the components of the displacement of each
/// function of corners and faces (CellPoint).
///
/// The divergence of the displacement is projected on polynomials of one order less than the displacement (Hughes 1980,
/// "B-bar"), so that a nearly incompressible cell keeps enough ways to move. On cells of second order, where it is
/// linear in x and y, the pair is that of Crouzeix and Raviart (1973) on triangles and of Q2-P1 on quadrilaterals,
/// which fulfils the inf-sup condition.
struct CellStiffness {
  Eigen::MatrixXd of_unknowns;  ///< without the interior function, which has been eliminated at second order
  /// Forces on the unknowns by a unit force on the interior function, a row for each axis; 0 at first order, which has
  /// none.
  CellPoint::Gradients of_interior;
};

CellStiffness cell_stiffness(const std::vector<CellPoint>& points, const Stiffness& stiffness, ElementOrder order);

}  // namespace sprekk::poromechanics
