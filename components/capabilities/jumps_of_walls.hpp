// Capabilities of fronts of fractures in space.
#pragma once

#include <string>

#include "components/capabilities/rock_state.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// The displacement jumps of walls, and the stiffness of the rock beside them.
class JumpsOfWalls {
 public:
  virtual ~JumpsOfWalls() = default;
  /// Reads the current values of the fields. To be called before `jump` when they have changed. Collective.
  virtual void update() = 0;
  /// u(minus) − u(plus), m, in global components. The cell may belong to any process.
  virtual Point jump(int fracture_cell) const = 0;
  /// Pa, of a cell of the rock. Throws std::runtime_error where the rock is anisotropic.
  virtual LameParameters stiffness(int cell) const = 0;
  /// Why the jumps next to fronts have an error that does not vanish on finer meshes; empty where they converge.
  virtual std::string flaw_of_jumps() const = 0;
};

/// Capability: gives stress intensity factors along fronts, and needs the jumps behind them.
class FractureFronts {
 public:
  static constexpr const char* promise = "gives stress intensity factors along the fronts of fractures";
  virtual ~FractureFronts() = default;
  /// To be called while the scene is built. `jumps` must outlive this object.
  virtual void accept_jumps(JumpsOfWalls& jumps) = 0;
};

}  // namespace sprekk
