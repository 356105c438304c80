// The heat of the fluid that has entered and left cells.
#pragma once

#include <string>
#include <vector>

#include "couplers/heat_advection/streams.hpp"
#include "framework/assembly/part.hpp"
#include "framework/scene/component.hpp"

namespace sprekk::couplers {

/// The cells of the rock, or of the fractures; empty without flow or heat there.
class CarriedHeat {
 public:
  CarriedHeat() = default;
  /// `where`: "rock" or "fractures", in names of fields; `fluid_heat_capacity`: J/(m^3 K).
  CarriedHeat(const CouplerContext& context, Field& temperature, Location location, const std::string& where,
              double fluid_heat_capacity);

  /// Throws DataError where the fluid that has left a cell since the start could store more heat than the cell could
  /// (`capacity`, J/(m K), one a cell): the balance of heat says nothing about the temperature there.
  void check(const Vector& capacity, const std::string& coupler) const;
  /// Counts what the streams have carried in the step, each with its temperature (K), when the temperatures at the end
  /// have been found. `capacity`: as above. `base`: what the products add up to whose sum a flux is
  /// (MatrixFluxes::round_off_base_of_fluxes).
  void count(const std::vector<Stream>& streams, const std::vector<double>& temperatures, const Vector& capacity,
             double base, double dt);
  void add_to(Balance& heat) const;

  Field* temperature = nullptr;
  Field* received = nullptr;    ///< m, m^2 (in space m^3): fluid that has entered since the start
  Field* cumulative = nullptr;  ///< (stored, injected, outflow) since the start, J/m
  Location location = Location::cell;

 private:
  const Mesh* mesh_ = nullptr;
  double fluid_heat_capacity_ = 0;
};

}  // namespace sprekk::couplers
