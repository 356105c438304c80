// Numbers on which the discretization of the flux depends.
#pragma once

#include "framework/discretization/ends_nearby.hpp"

namespace sprekk::matrix_flow {

/// Only tests take other values, to see how much answers depend on them (docs/numerics/tolerances.md).
struct MpfaLimits {
  /// Least ratio of the smallest singular value of the fit of a tip's flow to the largest; below, the modes are too
  /// similar to linear pressures.
  double well_posed = 1e-6;
  /// Largest amount of a mode (times the root of the edge length) for cell pressures that differ by 1: 5 to 8 on good
  /// meshes.
  double largest_share = 20;
  /// Largest relative difference of the permeability of a cell from that at a tip, since the flow around a tip is that
  /// in homogeneous rock.
  double alike = 0.2;
  /// Instead, cells of one region are alike: with a permeability that follows the state, a limit would make fluxes
  /// jump.
  bool alike_in_region = false;
  EndLimits near = {};
};

}  // namespace sprekk::matrix_flow
