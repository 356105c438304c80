// Capabilities of growing fractures.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "components/capabilities/rock_state.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// The state of the coarse level around tips: the reconstruction of boundary data of sec. 3.2 of the paper. Lengths s
/// (m) along a fracture count from its first point. Tractions and jumps are in global components. Functions of a place
/// x throw std::runtime_error outside of the rock.
class TipSurroundings {
 public:
  virtual ~TipSurroundings() = default;
  /// Reads the current values of the fields. To be called before all other functions when the fields have changed.
  virtual void update() = 0;
  /// A number that changes whenever the result of another function may change.
  virtual std::uint64_t version() const = 0;

  /// The region of the rock at x, an index into Mesh::region_names.
  virtual int region(const Point& x) const = 0;
  /// Throws std::runtime_error where the rock is anisotropic.
  virtual LameParameters stiffness(const Point& x) const = 0;
  /// 0 where one stiffness holds everywhere; otherwise a number that changes whenever that of some place has changed.
  virtual std::uint64_t stiffness_by_place() const { return 0; }
  /// The faces between cells of different stiffness, except for walls of fractures, each by its nodes, m. They may
  /// change with stiffness_by_place.
  using Border = std::array<Point, dimension>;
  virtual const std::vector<Border>& stiffness_borders() const {
    static const std::vector<Border> none_at_all;
    return none_at_all;
  }
  /// The displacement at x, m. `inside` is a point near x on the side of the fracture that is meant.
  virtual Point displacement(const Point& x, const Point& inside) const = 0;
  /// A function that gives the stress without strain (of the pore pressure and the initial stress) at the last update:
  /// (xx, yy, xy) in Pa, a column for each place. The places are located once. The function must not outlive this
  /// object. `pores`: where the pressure of the pores is taken for each place (m): another place beside an arc of the
  /// fine level, whose segment is straight in the rock.
  using StressOffsets = std::function<Eigen::Matrix<double, symmetric_components, Eigen::Dynamic>()>;
  virtual StressOffsets stress_offsets(const std::vector<Point>& places, const std::vector<Point>& pores) const = 0;
  /// A function that gives the weight of the rock and the body force at the last update: (x, y) in N/m^3, a column for
  /// each place. Empty where there is none. As for stress_offsets.
  using BodyForces = std::function<Eigen::Matrix<double, dimension, Eigen::Dynamic>()>;
  virtual BodyForces body_forces(const std::vector<Point>& places) const = 0;
  /// Whether walls of the fine level have a given jump (Eq. 15 of the paper); otherwise they have a given traction.
  virtual bool gives_jumps() const = 0;
  virtual Point wall_traction(int fracture, double s) const = 0;  ///< Pa, n·sigma of the plus wall, fluid included
  /// Walls that slide, or are open, within their cell, in global components. Where they touch, g·[u] = opening, and the
  /// traction on the plus wall is fluid + f t with f < 0; elsewhere it is that of the fluid, and g·[u] > opening.
  struct Sliding {
    Point fluid;     ///< Pa
    Point traction;  ///< t, per normal traction
    Point gap;       ///< g, unit along the normal
    double opening;  ///< m
  };
  /// Nothing where the walls stick or have grown, and where their law is not known.
  virtual std::optional<Sliding> sliding(int /*fracture*/, double /*s*/) const { return std::nullopt; }
  virtual Point wall_jump(int fracture, double s) const = 0;  ///< m, u(minus) − u(plus)
  /// Why the jumps next to tips have an error that does not vanish on finer meshes; empty where they converge.
  virtual std::string flaw_of_jumps() const { return {}; }
  /// The fluid pressure in the fracture cell at an end, Pa; 0 without a component for it.
  virtual double fluid_pressure(int fracture, bool at_end) const = 0;
  virtual double accepted_fluid_pressure(int fracture, bool at_end) const = 0;
  /// The viscosity of the fluid there, Pa s; 0 where there is none, or where it does not flow between open walls.
  virtual double fluid_viscosity(int fracture, bool at_end) const = 0;
  /// The part of the opening of the last fracture cell at this end that has fluid in it, between 0 and 1.
  virtual double filled_part(int fracture, bool at_end) const = 0;
  /// The norm of the displacement jump (normal and tangential) in the fracture cell at an end, m.
  virtual double jump_at_tip(int fracture, bool at_end) const = 0;
  /// epsilon_p of sec. 4.4.2 of the paper: a path of at least this part of the coarse mesh size is passed to the coarse
  /// level. Without a value the component of the tips has one of its own.
  virtual std::optional<double> propagation_threshold() const = 0;
};

/// Capability: has tips that can grow, and needs the coarse level around them.
class FractureTips {
 public:
  static constexpr const char* promise = "has tips that can grow";
  virtual ~FractureTips() = default;
  /// To be called while the scene is built. `surroundings` must outlive this object.
  virtual void accept_surroundings(TipSurroundings& surroundings) = 0;
};

/// Capability: has tips that may move.
class MovingTips {
 public:
  static constexpr const char* promise = "has tips that may move";
  virtual ~MovingTips() = default;
  /// An end of a fracture that moves.
  struct Tip {
    int fracture;
    bool at_end;   ///< at the last cell of the fracture, not at its first one
    double speed;  ///< m/s, mean of the step
  };
  /// The tips that have grown in the present step.
  virtual std::vector<Tip> moving_tips() const = 0;
};

}  // namespace sprekk
