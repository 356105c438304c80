// The cubic law: smooth parallel walls.
#pragma once

#include <algorithm>

#include "components/fracture_flow/laws/hydraulic_law.hpp"

namespace sprekk::fracture_flow {

/// h = a, but not below the residual hydraulic aperture (Witherspoon et al., Water Resour. Res. 16 (1980) 1016).
class CubicLaw : public HydraulicLaw {
 public:
  explicit CubicLaw(double lowest) : lowest_(lowest) {}
  HydraulicAperture at(double aperture) const override {
    return {std::max(aperture, lowest_), aperture >= lowest_ ? 1.0 : 0.0};
  }

 private:
  double lowest_;
};

}  // namespace sprekk::fracture_flow
