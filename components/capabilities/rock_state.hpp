// What the rock tells of its state, for those who look closer at a part of it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "framework/field/field.hpp"

namespace sprekk {

/// Isotropic stiffness in plane strain, Pa.
struct LameParameters {
  double lambda, shear;
};

/// "I give displacement, stress and stiffness of the rock."
class RockState {
 public:
  static constexpr const char* promise = "gives displacement, stress and stiffness of the rock";
  virtual ~RockState() = default;
  /// m, (x, y) of each cell.
  virtual const Field& displacement() const = 0;
  /// m, (x, y) of each face with one cell, at its centre; 0 of others.
  virtual Vector outer_displacement() const = 0;
  /// Pa, one a cell: what the pore pressure adds to xx and yy of the stress, −alpha (p − p_0).
  virtual Vector pore_stress() const = 0;
  /// Pa, (xx, yy, xy).
  virtual Eigen::Vector3d initial_stress(int cell, const Point& x) const = 0;
  /// Nothing for an anisotropic rock.
  virtual std::optional<LameParameters> stiffness(int cell) const = 0;
  /// Grows when the stiffness has changed, or alpha of the pore pressure.
  virtual std::uint64_t properties_version() const = 0;
};

}  // namespace sprekk
