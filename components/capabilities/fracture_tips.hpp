// Capabilities of growing fractures.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "components/capabilities/rock_state.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// The coarse level as tips see it: the reconstruction of boundary data of sec. 3.2 of the paper. Lengths s (m) along a
/// fracture count from its first point. Tractions and jumps are in global components.
class TipSurroundings {
 public:
  virtual ~TipSurroundings() = default;
  /// To be called before anything else is asked about new values of the fields.
  virtual void update() = 0;
  /// Changes whenever an answer may.
  virtual std::uint64_t version() const = 0;

  /// Throws std::runtime_error where the rock is anisotropic.
  virtual LameParameters stiffness(const Point& x) const = 0;
  /// m; `inside`, a point near x in the part of the rock that asks, tells the side of a fracture.
  virtual Point displacement(const Point& x, const Point& inside) const = 0;
  /// Stress without strain, of the pore pressure and the initial stress, at places that are looked for once: gives
  /// those of the last update, (xx, yy, xy) in Pa, a column a place. Not to be asked when this object is gone.
  using StressOffsets = std::function<Eigen::Matrix3Xd()>;
  virtual StressOffsets stress_offsets(const std::vector<Point>& places) const = 0;
  /// Whether the walls are held by their jump (Eq. 15 of the paper) or by their traction.
  virtual bool gives_jumps() const = 0;
  virtual Point wall_traction(int fracture, double s) const = 0;  ///< Pa, n·sigma of the plus wall, fluid included
  virtual Point wall_jump(int fracture, double s) const = 0;      ///< m, u(minus) − u(plus)
  /// Pa, in the fracture cell at an end; 0 where no fluid is known.
  virtual double fluid_pressure(int fracture, bool at_end) const = 0;
  virtual double accepted_fluid_pressure(int fracture, bool at_end) const = 0;
  /// m, the tangential and normal jump of the cell at an end, its size.
  virtual double jump_at_tip(int fracture, bool at_end) const = 0;
  /// epsilon_p of sec. 4.4.2 of the paper: the part of the coarse mesh size from which on a path is handed to the
  /// coarse level.
  virtual double propagation_threshold() const = 0;
};

/// "I have tips that can grow."
class FractureTips {
 public:
  static constexpr const char* promise = "has tips that can grow";
  virtual ~FractureTips() = default;
  /// To be called while the scene is built; it must outlive this object.
  virtual void accept_surroundings(TipSurroundings& surroundings) = 0;
};

}  // namespace sprekk
