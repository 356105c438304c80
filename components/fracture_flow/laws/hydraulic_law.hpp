// How a fracture conducts: the interface of the laws for the hydraulic aperture.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace sprekk::fracture_flow {

/// The aperture of the smooth parallel walls that conduct as the fracture does, and its derivative by the aperture.
struct HydraulicAperture {
  double value;  ///< h, m: the transmissivity is h^3/12 over the viscosity
  double by_aperture;
};

/// A law for the hydraulic aperture. It conducts only: the stored volume is that of the aperture itself.
class HydraulicLaw {
 public:
  virtual ~HydraulicLaw() = default;
  /// For an aperture (m) of either sign: a closed fracture may have a negative one to round-off.
  virtual HydraulicAperture at(double aperture) const = 0;
};

/// The parameters of all laws; each takes what it needs.
struct HydraulicLawParameters {
  double lowest = 0;     ///< m, lower bound of the hydraulic aperture; positive
  double roughness = 0;  ///< m, height of the asperities
};

/// The names that a scene may write for laws of the aperture, each with what it says.
std::vector<std::pair<std::string, std::string>> hydraulic_law_names();
/// The law of this name.
std::unique_ptr<HydraulicLaw> make_hydraulic_law(const std::string& name, const HydraulicLawParameters& parameters);

}  // namespace sprekk::fracture_flow
