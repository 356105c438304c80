// The state of the rock, for a finer model of a part of it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "framework/field/field.hpp"

namespace sprekk {

/// Lame's constants of isotropic rock, Pa; in a plane for plane strain.
struct LameParameters {
  double lambda, shear;
};

/// Capability: gives displacement, stress, weight and stiffness of the rock.
class RockState {
 public:
  static constexpr const char* promise = "gives displacement, stress and stiffness of the rock";
  virtual ~RockState() = default;
  /// The displacement of each cell or of each node, m, a component for each axis.
  virtual const Field& displacement() const = 0;
  /// The displacement at the centre of each face with one cell, m, a component for each axis; other values have no
  /// meaning.
  virtual Vector outer_displacement() const = 0;
  /// The stress −alpha (p − p_0) that the pore pressure adds to the normal components, for each cell, Pa.
  virtual Vector pore_stress() const = 0;
  /// The derivative of pore_stress() by this pressure, −alpha of each cell; empty where this pressure is no load.
  virtual Vector pore_stress_by(const Field& pressure) const = 0;
  /// The initial stress at a point x of a cell, Pa; where rock is taken away, the part of it that still acts.
  virtual SymmetricTensor initial_stress(int cell, const Point& x) const = 0;
  /// Whether the initial stress at a place may change in the run.
  virtual bool initial_stress_changes() const = 0;
  /// Whether there is any weight or body force.
  virtual bool has_body_force() const = 0;
  /// The weight of the rock and the body force at a point x of a cell at the end of the step, N/m^3.
  virtual Point body_force(int cell, const Point& x) const = 0;
  /// The stiffness of a cell; std::nullopt where the rock is anisotropic.
  virtual std::optional<LameParameters> stiffness(int cell) const = 0;
  /// A number that grows when the stiffness, or alpha of the pore pressure, has changed.
  virtual std::uint64_t properties_version() const = 0;
};

}  // namespace sprekk
