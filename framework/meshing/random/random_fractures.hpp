// Sets of fractures that are drawn at random.
#pragma once

#include <optional>
#include <string>

#include "framework/meshing/geometry.hpp"

namespace sprekk {

/// The law of the lengths of a set.
struct LengthLaw {
  /// The density: one value, a power of the length, or lognormal.
  enum class Kind { constant, power, lognormal };
  Kind kind = Kind::constant;
  double value = 0;             ///< m, of a constant
  double exponent = 0;          ///< exponent of a power law: the density is proportional to length^(-exponent)
  double median = 0;            ///< m, of the lognormal law before it is cut
  double deviation = 0;         ///< of the lognormal law: standard deviation of the logarithm
  double shortest = 0;          ///< m, also of a constant
  double longest = 0;           ///< m
  double draw(double u) const;  ///< m, for a u between 0 and 1
  bool operator==(const LengthLaw&) const = default;
};

/// A set of straight fractures, in space of squares: how many, how long, which way, where, and how far from one
/// another.
struct RandomFractures {
  std::string name;  ///< they are called name_1, name_2, …; the longest first
  Origin origin;
  // One of these three says how many.
  std::optional<int> number;
  std::optional<double> density;    ///< P20: fractures for each area, 1/m^2; in space P30: for each volume, 1/m^3
  std::optional<double> intensity;  ///< P21: length for each area, 1/m; in space P32: area for each volume
  LengthLaw length;
  double mean_angle = 0;                 ///< rad, counter-clockwise from the x axis; in a plane
  double mean_strike = 0, mean_dip = 0;  ///< rad, clockwise from north and down to the right of it; in space
  /// Of von Mises' law about the mean, in space of Fisher's law of normals; 0: all directions are equally likely.
  double concentration = 0;
  std::optional<Box> region;  ///< where their middles lie; by default in the box
  int seed = 1;
  double least_angle = 0;  ///< rad, between fractures that cross
  double least_gap = 0;    ///< m, see draw_fractures
};

/// Draws a set and adds it to the geometry, after the fractures that it has. Lengths and directions follow their laws
/// exactly. A place is drawn anew until
/// - the fracture lies in the box, `least_gap` from its sides or farther,
/// - no end of it or of another fracture or edge of a region is nearer than `least_gap` to the other line,
/// - it crosses others at `least_angle` or more, and no two crossings are nearer to each other than `least_gap`,
/// so that places are uniform in the region except for these conditions. The longest are placed first. Coordinates are
/// multiples of a power of ten, below a 1e-6th of the box, so that a table holds them with few digits. In space the
/// rims of fractures take the place of ends, coordinates have all digits, and lines along which fractures cross may be
/// near to one another. Throws InputError when there is no place for all fractures, or when the set has none or more
/// than most_random_fractures.
void draw_fractures(const RandomFractures& set, Geometry& geometry);

/// A mesh of more would have millions of cells.
inline constexpr int most_random_fractures = 10000;

}  // namespace sprekk
