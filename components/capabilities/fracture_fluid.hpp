// Capabilities of the flow in the fractures.
#pragma once

#include "framework/field/field.hpp"

namespace sprekk {

/// "I determine the pressure in the fractures from a balance of fluid volume, and accept their aperture."
class FractureFluid {
 public:
  static constexpr const char* promise = "determines the pressure in the fractures";
  virtual ~FractureFluid() = default;
  /// Pa, one a fracture cell. Its equation is the volume that it stores, less what entered during the step (m^2).
  virtual Field& pressure() = 0;
  /// Input, m, one a fracture cell; the initial aperture a0 (below Eq. 8 of the paper) until a coupler determines it.
  virtual Field& aperture() = 0;
  virtual const Vector& initial_aperture() const = 0;

  /// The permeability normal to the fracture, kappa = 2 K/(mu a^2) (below Eq. 9 of the paper), m/(Pa s), one a fracture
  /// cell, at the current aperture, and its derivative by the aperture.
  struct NormalPermeability {
    Vector value, by_aperture;
  };
  virtual NormalPermeability normal_permeability() const = 0;
};

}  // namespace sprekk
