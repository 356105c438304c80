// The variables on which the strength of walls depends.
#pragma once

#include <array>
#include <cstddef>

namespace sprekk::contact {

/// The state of walls: slip (m, its size), path (m, of slip and opening), slip rate (m/s), and the pressure between
/// them (Pa, not negative).
using WallState = std::array<double, 4>;
/// Their places in it.
enum WallVariable : std::size_t { slip_of_walls, path_of_walls, slip_rate_of_walls, pressure_of_walls };

/// A value, with its derivatives by the variables.
struct OfWalls {
  double value = 0;
  WallState by{};
};

}  // namespace sprekk::contact
