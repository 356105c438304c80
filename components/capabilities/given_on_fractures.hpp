// Capabilities of a component that gives values on fractures, and of those that accept them.
#pragma once

#include <string>

#include "framework/field/field.hpp"

namespace sprekk {

/// Capability: determines the aperture of fractures by a law of its own.
class GivesAperture {
 public:
  static constexpr const char* promise = "gives the aperture of fractures";
  virtual ~GivesAperture() = default;
  virtual const Field& given_aperture() const = 0;  ///< m, one a fracture cell
};

/// Capability: determines a factor by which friction on fractures changes.
class GivesFriction {
 public:
  static constexpr const char* promise = "gives a factor of friction on fractures";
  virtual ~GivesFriction() = default;
  virtual const Field& friction_factor() const = 0;  ///< one a fracture cell, not negative
};

/// Capability: accepts a factor of friction.
class AcceptsFriction {
 public:
  static constexpr const char* promise = "accepts a factor of friction";
  virtual ~AcceptsFriction() = default;
  /// Multiplies friction by the present values of the field from now on. Returns why it cannot, or "". To be called
  /// while the scene is built; the field must outlive this object.
  virtual std::string accept_friction_factor(const Field& factor) = 0;
};

}  // namespace sprekk
