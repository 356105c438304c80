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
  /// Which state of the fields the density belongs to: that at the start of the step, or the current iterate.
  enum class State { accepted, now };
  virtual ~FluidDensity() = default;
  /// The density of each cell, kg/m^3.
  virtual Vector values(State state) const = 0;
  /// The versions of the fields that `values` depends on: equal versions mean equal values.
  using Version = std::array<std::uint64_t, 2>;
  virtual Version version(State state) const = 0;
  /// The derivative of each cell's present density by the value of the field in this cell, kg/m^3 per unit of it.
  struct Derivative {
    const Field* field;
    Vector values;
  };
  virtual std::vector<Derivative> derivatives() const = 0;
  /// The density of the fluid at a place with a prescribed pressure (Pa), kg/m^3; none where the density of the cell
  /// beside it holds there, too. `place`: an outer face of the rock, or a ridge.
  virtual std::optional<double> at_boundary(int place, double pressure) const = 0;
};

/// Capability: the fluid of the matrix may have a density that varies.
class BuoyantMatrix {
 public:
  static constexpr const char* promise = "flows in the matrix by its weight";
  virtual ~BuoyantMatrix() = default;
  virtual bool has_gravity() const = 0;
  /// The difference of the pressures at `to` and at `from`, Pa, in fluid at rest that has the scene's constant density.
  virtual double weight_between(const Point& from, const Point& to) const = 0;
  /// Whether a density that varies has been accepted.
  virtual bool density_varies() const = 0;
  /// From now on the weight of the fluid follows this density instead of the scene's; volumes of fluid do not.
  /// `in_fractures`: the density in fractures, which holds at their walls; nullptr: at walls the density of the rock
  /// cell holds. Both must outlive this object. To be called while the scene is built.
  virtual void accept_density(const FluidDensity& in_rock, const FluidDensity* in_fractures) = 0;
};

/// Capability: the fluid of the fractures may have a density that varies.
class BuoyantFractures {
 public:
  static constexpr const char* promise = "flows in the fractures by its weight";
  virtual ~BuoyantFractures() = default;
  virtual bool has_gravity() const = 0;
  /// The difference of the pressures at `to` and at `from`, Pa, as in BuoyantMatrix.
  virtual double weight_between(const Point& from, const Point& to) const = 0;
  virtual bool density_varies() const = 0;
  /// Gives the fluid of the fractures this density, as BuoyantMatrix::accept_density does for the rock.
  virtual void accept_density(const FluidDensity& in_fractures) = 0;
};

}  // namespace sprekk
