// Capability of wells, whose pressure and rates are unknowns.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/config/input_error.hpp"
#include "framework/field/field.hpp"

namespace sprekk {

/// A place where a well is open to what is around it.
struct WellPlace {
  int well = 0;      ///< index of the well
  std::string name;  ///< of the well in the scene, with that of the place where it has several
  Origin origin;
  Point at = Point::Zero();
  std::optional<std::string> fracture;  ///< open to this fracture, and else to the rock
  double radius = 0;                    ///< m
  double skin = 0;
  /// Rate over difference of pressure, m^2/(Pa s), in space m^3/(Pa s); absent where it follows from the mesh.
  std::optional<double> index;
  /// In space: a straight piece of a line along which the well is open to the rock, in one cell. The pieces of a line
  /// follow one another, and have the same name.
  struct Piece {
    int cell;
    Point from, to;           ///< m
    std::vector<Point> line;  ///< the whole line, m
    double length() const { return (to - from).norm(); }
  };
  std::optional<Piece> piece;
};

/// What surrounds a place: cells of the rock or of fractures, with their shares of the rate there.
struct AroundWell {
  const Field* pressure = nullptr;                  ///< of the flow to which the place is open
  std::vector<std::pair<int, double>> shares = {};  ///< which add up to 1
};

/// Capability: determines the pressure in wells from their rates.
class WellPressures {
 public:
  static constexpr const char* promise = "determines the pressure in wells";
  virtual ~WellPressures() = default;
  /// The pressure in each well, Pa.
  virtual Field& pressure() = 0;
  /// Input: the rate out of the well at each place, m^2/s (in space m^3/s).
  virtual Field& rate() = 0;
  virtual const Field& rate() const = 0;
  virtual const std::vector<WellPlace>& places() const = 0;
  virtual const std::vector<std::string>& names() const = 0;
  /// Whether the rate that a well is to have in this step injects fluid.
  virtual bool is_to_inject(int well) const = 0;
  /// Takes what surrounds each place. To be called by the coupler that determines the rates, while the scene is built,
  /// and in Part::begin_step where it has changed.
  virtual void accept_surroundings(std::vector<AroundWell> around) = 0;
  /// What accept_surroundings was given. Empty before that: couplers are built in any order.
  virtual const std::vector<AroundWell>& surroundings() const = 0;
  /// The pressure around the wells at the start, Pa, one a place, from which the pressure of wells begins. Throws
  /// InputError for limits that contradict it.
  virtual void begin_with(const Vector& around) = 0;
  /// The difference of pressure over the rate, Pa s/m^2, one a place, positive: the scale of the equations. To be given
  /// in Part::begin_step of couplers.
  virtual void scale(const Vector& resistance) = 0;
};

}  // namespace sprekk
