// The heat or tracer in the fluid that has entered and left cells.
#pragma once

#include <string>
#include <vector>

#include "components/capabilities/carried.hpp"
#include "couplers/advection/streams.hpp"
#include "framework/assembly/part.hpp"
#include "framework/scene/component.hpp"

namespace sprekk::couplers {

/// The cells of the rock, or of the fractures; empty without flow there, or where nothing is carried.
class FluidContents {
 public:
  FluidContents() = default;
  /// `where`: "rock" or "fractures", in names of fields; `per_volume`: capacity of the fluid per volume, J/(m^3 K), or
  /// 1; `decay`: 1/s, one a cell, or empty.
  FluidContents(const CouplerContext& context, const Carried& carried, Field& value, Location location,
                const std::string& where, double per_volume, Vector decay);

  /// Throws DataError if the fluid that has left a cell since the start could hold more than the cell itself
  /// (`capacity`, one a cell): the balance does not determine the value there.
  void check(const Vector& capacity, const std::string& coupler) const;
  /// To be called when the values at the end of the step are known: counts what each stream has carried, with its
  /// value. `capacity`: as above. `base`: the sum of absolute terms of each flux, for its round-off
  /// (MatrixFluxes::round_off_base_of_fluxes).
  void count(const std::vector<Stream>& streams, const std::vector<double>& values, const Vector& capacity, double base,
             double dt);
  void add_to(Balance& balance) const;

  /// What the fluid that had entered by the start of the step holds, per unit of the value.
  Vector capacity_at_start() const { return per_volume_ * received->accepted(); }
  /// What that fluid would hold with the value at the start, less what it holds. It is 0 except in the second stage of
  /// a step (TimeScheme::sdirk2), whose start has extrapolated amounts of fluid, values, and products of both.
  Vector not_held_at_start() const;

  Field* value = nullptr;
  Field* received = nullptr;    ///< m, m^2 (in space m^3): fluid that has entered since the start
  Field* held = nullptr;        ///< m T: what that fluid holds, over what it holds per volume and value
  Field* cumulative = nullptr;  ///< (stored, injected, outflow or decayed) since the start
  Location location = Location::cell;
  Vector decay;  ///< 1/s, one a cell; empty where nothing decays

 private:
  const Mesh* mesh_ = nullptr;
  const Carried* carried_ = nullptr;
  double per_volume_ = 0;
};

}  // namespace sprekk::couplers
