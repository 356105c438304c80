// Capability of flow along fractures in space: what a bore hole feels that meets a fracture at a point.
#pragma once

#include "components/capabilities/fracture_fluid.hpp"
#include "framework/config/input_error.hpp"

namespace sprekk {

/// Capability: tells the resistance of a fracture around a bore hole.
class BoreHolesInFractures {
 public:
  static constexpr const char* promise = "tells the resistance of a fracture around a bore hole";
  virtual ~BoreHolesInFractures() = default;
  /// ln(r_e/r) for a bore hole of the radius r (m) at a point of a fracture cell, with the radius r_e that the cells
  /// stand for among which FractureFluid::shares_at shares its rate. Throws InputError where the cells are too small,
  /// or at the rim of their fracture.
  virtual double log_of_radii(int cell, const Point& at, double radius, const Origin& where) const = 0;
  /// By how much the pressure of the bore hole exceeds the mean of these cells, for each unit of its rate: ln(r_e/r)
  /// over 2 pi and the conductance of the cell.
  virtual FractureFluid::Rise rise_at_bore(int cell, double log_of_radii) const = 0;
};

}  // namespace sprekk
