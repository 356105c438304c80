// Exact fields near a tip of a straight crack whose walls are free, in the frame of the tip.
#pragma once

#include <array>

#include "components/fine_fracture/fine_level/elasticity.hpp"

namespace sprekk::fine_fracture {

/// An auxiliary field at a place, as an interaction integral needs it; in the frame of the tip.
struct AuxiliaryPoint {
  Tensor stress;             ///< Pa
  Point displacement_along;  ///< du/dx1
  Tensor strain_along;       ///< d eps/dx1, 1/m
};

/// The auxiliary fields. opening, sliding: the singular fields of K_I = 1 and of K_II = 1 Pa m^1/2. force: that of a
/// point force of 1 N/m at the tip along x1, for the T-stress (Kfouri 1986).
enum class Auxiliary { opening, sliding, force };

/// The field at distance r (m) from the tip and angle theta from its direction, from -pi (the lower wall) to pi (the
/// upper wall).
AuxiliaryPoint auxiliary_point(Auxiliary field, const Elasticity& rock, double r, double theta);
/// All three fields in the order of Auxiliary, at a place x off the walls.
std::array<AuxiliaryPoint, 3> auxiliary_points(const Elasticity& rock, const Point& x);

}  // namespace sprekk::fine_fracture
