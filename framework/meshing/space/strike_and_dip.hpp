// Flat shapes by the strike and dip of their plane.
#pragma once

#include <vector>

#include "framework/meshing/geometry.hpp"

namespace sprekk {

/// The direction of a plane, rad: its strike clockwise from north (y), and its dip to the right of the strike.
struct StrikeAndDip {
  double strike, dip;

  Point along_strike() const;  ///< horizontal, unit
  Point up_dip() const;        ///< unit
};

/// The corners of a rectangle with this middle, m. They turn counter-clockwise about its normal, which points up and to
/// the right of the strike.
std::vector<Point> rectangle(const Point& center, const StrikeAndDip& plane, double length, double height);

/// An ellipse with half axes along strike and along dip, m; the normal as for a rectangle.
Ellipse ellipse(const Point& center, const StrikeAndDip& plane, double along_strike, double along_dip);

}  // namespace sprekk
