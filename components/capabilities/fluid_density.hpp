// A density of the fluid that varies, and capabilities of flows whose fluid may have one.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "framework/field/field.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// The density of a fluid as a function of fields, one value a cell of the rock or of the fractures.
class FluidDensity {
 public:
  /// At the start of a step, or at its end as far as it has been found.
  enum class State { accepted, now };
  virtual ~FluidDensity() = default;
  /// kg/m^3.
  virtual Vector values(State state) const = 0;
  /// Changes whenever `values` does: the versions of the fields that it depends on.
  using Version = std::array<std::uint64_t, 2>;
  virtual Version version(State state) const = 0;
  /// The derivative of each cell's present density by the value of the field in this cell, kg/m^3 per unit of it.
  struct Derivative {
    const Field* field;
    Vector values;
  };
  virtual std::vector<Derivative> derivatives() const = 0;
  /// The density at a place with a prescribed pressure (Pa), if something else than the values of the cell determines
  /// it in this step, kg/m^3. `place`: an outer face of the rock, or a fracture point.
  virtual std::optional<double> at_boundary(int place, double pressure) const = 0;
};

/// Capability: the fluid of the matrix may have a density that varies.
class BuoyantMatrix {
 public:
  static constexpr const char* promise = "flows in the matrix by its weight";
  virtual ~BuoyantMatrix() = default;
  virtual bool has_gravity() const = 0;
  /// The pressure at `to` less that at `from` in fluid at rest of the scene's constant density, Pa.
  virtual double weight_between(const Point& from, const Point& to) const = 0;
  /// Whether a density that varies has been accepted.
  virtual bool density_varies() const = 0;
  /// The weight of the fluid follows this density instead of the scene's; volumes do not. `in_fractures`: the density
  /// at walls, that of the fracture cell beside; nullptr where that of the rock cell is to be taken. Both must outlive
  /// this object. To be called while the scene is built.
  virtual void accept_density(const FluidDensity& in_rock, const FluidDensity* in_fractures) = 0;
};

/// Capability: the fluid of the fractures may have a density that varies.
class BuoyantFractures {
 public:
  static constexpr const char* promise = "flows in the fractures by its weight";
  virtual ~BuoyantFractures() = default;
  virtual bool has_gravity() const = 0;
  /// As for the matrix.
  virtual double weight_between(const Point& from, const Point& to) const = 0;
  virtual bool density_varies() const = 0;
  /// As for the matrix.
  virtual void accept_density(const FluidDensity& in_fractures) = 0;
};

}  // namespace sprekk
