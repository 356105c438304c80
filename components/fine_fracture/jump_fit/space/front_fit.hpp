// Stress intensity factors along fronts, as sums of the jumps of the fracture cells behind them.
#pragma once

#include <vector>

#include "components/fine_fracture/jump_fit/options.hpp"
#include "components/fine_fracture/jump_fit/space/cells_behind.hpp"

namespace sprekk::fine_fracture {

/// A weighted sum of jumps. Its components times (E'/8, E'/8, G/4) are (K_II, K_I, K_III), Pa sqrt(m), in the order of
/// the axes of a RimEdge: ahead, towards the plus side, along the front.
struct FrontSum {
  /// What the jump of a cell adds.
  struct Part {
    int cell;
    double weight;  ///< m^-0.5
    Tensor axes;    ///< those of the front beside the cell
  };
  std::vector<Part> parts;
};

/// An edge of a front and the sums that give the factors at its middle.
struct FrontPlace {
  int ridge, fracture;
  int cell;    ///< the fracture cell there
  double arc;  ///< m, of its middle along the front
  FrontSum fitted;
  FrontSum with_one_less;  ///< from a strip that is one cell size shorter; empty where that does not give a line
};

/// By the expansion of Williams (J. Appl. Mech. 24 (1957) 109) the jumps at the distance r behind a front are
///   8/E' sqrt(r/(2 pi)) (K_I, K_II) and 4/G sqrt(r/(2 pi)) K_III, times 1 + c r + …,
/// in plane strain across the front and for shear along it. So the factors are where the straight line through the
/// apparent ones over r meets the front, as in a plane (factors_from_jumps). Where the line across the front meets
/// another front at r = L, jumps are sqrt(r (1 − r/L)) times a smooth function, which is a constant for ellipses under
/// uniform tractions (Eshelby, Proc. R. Soc. A 241 (1957) 376). Fractures are surfaces of triangles without rows:
/// the fit (least squares) goes over all cells within a strip behind the place, and has a parabola along the front. The
/// jump of a cell is a mean, so it is divided by the mean of sqrt(r (1 − r/L)).
std::vector<FrontPlace> fit_fronts(const Mesh& mesh, const JumpFitOptions& options);

}  // namespace sprekk::fine_fracture
