// Linear operators of Darcy flow on the matrix, whichever discretization made them.
#pragma once

#include <vector>

#include "framework/mesh/mesh.hpp"
#include "framework/types.hpp"

namespace sprekk::matrix_flow {

enum class FlowCondition { none, pressure, flux };  ///< of a face: none inside; walls of fractures are `flux`

/// With pressures p (one a cell, Pa) and boundary values b (one a face: the pressure at the face centre on `pressure`
/// faces, the outward flux integrated over the face, m^2/s, on `flux` faces, ignored inside):
///   flux through every face, out of face_cells[f][0], integrated over it (m^2/s): flux_cell p + flux_boundary b
///   pressure at the centre of every boundary and wall face (Pa):                  trace_cell p + trace_boundary b
struct FluxOperators {
  SparseMatrix flux_cell;       ///< faces × cells
  SparseMatrix flux_boundary;   ///< faces × faces
  SparseMatrix trace_cell;      ///< faces × cells; rows of inner faces are empty
  SparseMatrix trace_boundary;  ///< faces × faces; rows of inner faces are empty

  /// To move matrices would copy them.
  void swap(FluxOperators& other) {
    flux_cell.swap(other.flux_cell);
    flux_boundary.swap(other.flux_boundary);
    trace_cell.swap(other.trace_cell);
    trace_boundary.swap(other.trace_boundary);
  }
};

}  // namespace sprekk::matrix_flow
