// Stress-intensity factors of a finite-element solution.
#pragma once

#include <vector>

#include "components/fine_fracture/fine_level/fine_rock.hpp"
#include "components/fine_fracture/fine_level/loads.hpp"
#include "components/fine_fracture/quarter_point/elasticity/interaction_integral.hpp"
#include "components/fine_fracture/quarter_point/mesh/fine_mesh.hpp"

namespace sprekk::fine_fracture {

/// The stress-intensity factors of one tip, in its frame: x1 out of the crack along its direction, x2 = x1 turned by
/// +90 degrees. Pairs are (K_I, K_II) in Pa m^1/2. K_I > 0 opens; K_II > 0 moves the upper wall (x2 > 0) towards +x1
/// against the lower one.
struct TipIntensities {
  int crack;
  bool is_last;     ///< the last point of the path, else the first
  Point position;   ///< m
  Point direction;  ///< x1

  /// The best of the following values: K_interaction where walls carry tractions up to the tip. Where a jump is
  /// prescribed up to the tip, the jump alone determines K: there it is K_extrapolated.
  Point K;
  Point K_interaction;   ///< by the interaction integral over the larger domain
  Point K_inner;         ///< by the interaction integral over a smaller domain
  Point K_correlation;   ///< by displacement correlation with quarter points: G sqrt(2 pi / L) / (kappa + 1) [4 dv(L/4)
                         ///< - dv(L)]
  Point K_extrapolated;  ///< the same from dv(L/4) and dv(L) extrapolated linearly to the tip
  double T;              ///< sigma_11 - sigma_22 at the tip, Pa
  double energy_release_rate;  ///< (K_I^2 + K_II^2) / E', Pa m
  Point error;  ///< an estimate for K: how far K_interaction is from K_inner, or K_extrapolated from K_correlation
  double domain_radius;  ///< of the interaction integral, m
};

/// Where interaction integrals are taken. Only tests take other values, to see how much factors depend on them.
struct IntegralLimits {
  double domain_in_radii = 4;   ///< how far the domain reaches if there is room, in radii of the rosette
  double share_of_room = 0.75;  ///< of the way to kinks, other cracks and walls of another kind, at most
};

/// Finds the factors at one tip, in any solution on its mesh.
class TipEvaluation {
 public:
  /// Keeps references to the mesh and to its tip.
  TipEvaluation(const FineMesh& mesh, const FineRock& rock, const FineMesh::Tip& tip,
                const IntegralLimits& limits = {});
  /// The places at which stress offset and body force are needed.
  const std::vector<Point>& offset_places() const { return integrals_.offset_places(); }
  /// The factors in a solution. `loads`: those of the solution; `offsets`: a column (xx, yy, xy) for each of
  /// offset_places(), Pa, or no columns; `body_forces`: (x, y), N/m^3, in the same way; `displacement`: (x, y) per
  /// node, m.
  TipIntensities of(const FineLoads& loads, const Eigen::Ref<const Eigen::Matrix3Xd>& offsets,
                    const Eigen::Ref<const Eigen::Matrix2Xd>& body_forces, const Vector& displacement) const;

 private:
  const FineMesh::Tip& tip_;
  Elasticity rock_;  ///< at the tip
  double domain_radius_;
  bool has_jump_;  ///< prescribed up to the tip
  InteractionIntegrals integrals_;
};

}  // namespace sprekk::fine_fracture
