// Linear operators of the stress of the rock, whichever discretization made them.
#pragma once

#include "components/poromechanics/face_conditions.hpp"
#include "framework/types.hpp"

namespace sprekk::poromechanics {

/// Forces, traces and volume changes as linear functions of
/// - displacements u (of every cell, all d components, m; d is the dimension),
/// - isotropic stresses s (one for each cell, Pa; sigma = C : grad u − s I, so s is the Biot coefficient times p), and
/// - boundary values b (d for every face, in the directions of its FaceConditions). On `displacement` directions b is
///   the displacement of the face centre (m); on `traction` directions the force on the face, i.e. the traction sigma·n
///   integrated over it (N/m), n out of the rock; on `load` directions the total load on both cells of the face, the
///   sum of their sigma·n, n out of each (N/m). Other values of b are ignored.
///
/// Direction c of face f has the index d f + c. Forces, displacements and traces have the directions of the axes. In
/// space N/m stands for N, and m^2 for m^3.
/// - Force on every face, sigma·n integrated, n out of face_cells[f][0] (N/m):
///   force_displacement u + force_stress s + force_boundary b.
/// - Displacement at the centre of boundary and wall faces (m):
///   trace_displacement u + trace_stress s + trace_boundary b.
/// - Volume change, div u integrated over every cell (m^2):
///   volume_displacement u + volume_stress s + volume_boundary b.
///
/// Near the tip of a crack the traction on a face is not constant, and acts beside the centre x_f of the face.
/// Component k of face f (symmetric_axes, n of them) has the index n f + k.
/// - Moment on inner faces, the symmetric part of sigma·n (x − x_f) integrated (N): moment_displacement u.
struct StressOperators {
  SparseMatrix force_displacement, force_stress, force_boundary;     ///< d faces × (d cells, cells, d faces)
  SparseMatrix trace_displacement, trace_stress, trace_boundary;     ///< d faces × …; rows of inner faces are empty
  SparseMatrix volume_displacement, volume_stress, volume_boundary;  ///< cells × …
  SparseMatrix moment_displacement;                                  ///< n faces × d cells; mostly empty

  /// Eigen copies sparse matrices when they are moved; swap does not.
  void swap(StressOperators& other);
};

}  // namespace sprekk::poromechanics
