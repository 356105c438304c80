// A border of the regions of a flow that fluid crosses, with its parts of the operators.
#pragma once

#include <array>
#include <vector>

#include "framework/assembly/linear_expression.hpp"
#include "framework/field/field.hpp"

namespace sprekk::matrix_flow {

/// See MatrixBorder::open_border. The boundary value (FluxOperators) of each of its faces is sign · measure · outflow.
struct OpenBorder {
  const Field* outflow;     ///< m/s, one a face
  double sign;              ///< of `outflow` where fluid leaves this flow
  std::vector<char> faces;  ///< one flag a face
  SparseMatrix boundary;    ///< faces × faces: the boundary value
  SparseMatrix flux;        ///< faces × faces: what is added to the flux through every face
  Operator of_cells;        ///< cells × faces: sums of the fluxes out of cells, an exchange
  Operator continuity;      ///< faces × faces: of the equations of face pressures
  /// Faces × faces: what is added to each of FluxOperators::limited; empty where fluxes are linear.
  std::array<SparseMatrix, 2> limited = {};
  LinearExpression pressure = {};  ///< see MatrixBorder::border_pressure
};

/// The pressure at the centres of the faces of all borders that a process owns (Pa), as in FluxOperators:
///   cell p + boundary b + change s + face h.
struct BorderTraces {
  SparseMatrix cell;      ///< faces × cells
  SparseMatrix boundary;  ///< faces × faces
  SparseMatrix change;    ///< faces × directions of faces
  SparseMatrix face;      ///< faces × faces, applied to the pressures h of faces
};

}  // namespace sprekk::matrix_flow
