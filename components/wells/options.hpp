// What a scene says of wells.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/spec.hpp"

namespace sprekk::wells {

/// A place where a well is open.
struct Perforation {
  Origin origin;
  std::optional<Point> at;    ///< m
  std::vector<Point> points;  ///< m, in space: of a line in the rock
  std::optional<std::string> fracture;
  std::optional<double> index;  ///< m^2/(Pa s), in space m^3/(Pa s), of the whole line
};

/// One well: what it is to do, its limits, and its places.
struct WellOptions {
  Origin origin;
  std::optional<Data> rate;                               ///< m^2/s (in space m^3/s), out of the well
  std::optional<Data> pressure;                           ///< Pa
  std::optional<Data> lowest_pressure, highest_pressure;  ///< Pa
  double radius = 0.1;                                    ///< m
  double skin = 0;
  Perforation only;                           ///< where it has one place
  std::map<std::string, Perforation> places;  ///< where it has several
};

/// Parameters of all wells.
struct Options {
  std::map<std::string, WellOptions> wells;
  Spec spec();
};

}  // namespace sprekk::wells
