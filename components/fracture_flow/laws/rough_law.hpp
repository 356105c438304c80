// The law of Lomize: rough walls.
#pragma once

#include <cmath>

#include "components/fracture_flow/laws/hydraulic_law.hpp"

namespace sprekk::fracture_flow {

/// h^3 = a^3/(1 + 6 (e/a)^1.5), but not below the residual hydraulic aperture, for asperities of the height e (Lomize,
/// Flow in Fractured Rocks, Gosenergoizdat, Moscow 1951; Witherspoon et al., Water Resour. Res. 16 (1980) 1016).
class RoughLaw : public HydraulicLaw {
 public:
  RoughLaw(double lowest, double roughness) : lowest_(lowest), roughness_(roughness) {}
  HydraulicAperture at(double aperture) const override {
    if (!(aperture > 0)) return {lowest_, 0};
    constexpr double factor = 6, exponent = 1.5;  // Lomize 1951, as above
    const double excess = factor * std::pow(roughness_ / aperture, exponent);
    const double value = aperture / std::cbrt(1 + excess);
    if (!(value >= lowest_)) return {lowest_, 0};
    return {value, value / aperture * (1 + exponent / 3 * excess / (1 + excess))};
  }

 private:
  double lowest_, roughness_;
};

}  // namespace sprekk::fracture_flow
