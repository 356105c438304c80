// The interface of the laws for the hydraulic aperture of a fracture.
#pragma once

namespace sprekk::fracture_flow {

/// The hydraulic aperture h, that of smooth parallel walls with the transmissivity of the fracture, and its derivative
/// by the aperture.
struct HydraulicAperture {
  double value;  ///< h, m: the transmissivity is h^3/12 over the viscosity
  double by_aperture;
};

/// A law for the hydraulic aperture. The hydraulic aperture is for flow only: the stored volume is that of the aperture
/// itself.
class HydraulicLaw {
 public:
  virtual ~HydraulicLaw() = default;
  /// For an aperture (m) of either sign: a closed fracture may have a negative one to round-off.
  virtual HydraulicAperture at(double aperture) const = 0;
};

}  // namespace sprekk::fracture_flow
