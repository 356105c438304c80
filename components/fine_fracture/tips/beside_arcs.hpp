// Which place on the coarse level a place beside an arc of the fine level is.
#pragma once

#include <vector>

#include "framework/types.hpp"

namespace sprekk::fine_fracture {

/// The last segment of a path is an arc of two pieces on the fine level, and their chord, a straight cell, on the
/// coarse one. A place between arc and chord lies on the other side of the fracture there; and beside a wall, the
/// pressure of the pores on the coarse level follows the distance from the chord. So places in a strip along the chord,
/// four heights of the arc wide to both sides, are moved across it: at the arc onto the chord, at the rim of the strip
/// not at all, and linearly in between. Places on the arc itself belong to no side, and stay.
class BesideArcs {
 public:
  /// m: the ends of the chord, and the point where the pieces of the arc meet. An arc that turns back has no strip.
  void add(const Point& from, const Point& middle, const Point& to);
  /// m, of places in a convex outline. A place that would leave it stays.
  std::vector<Point> on_coarse_level(std::vector<Point> places, const std::vector<Point>& outline) const;

 private:
  struct Arc {
    Point from, along, normal;      ///< the chord begins at `from`; unit vectors
    double length, middle, height;  ///< m, of the chord; where the pieces meet, along and across it
    double reach;                   ///< m, half the width of the strip
  };
  static Point moved(const Arc& arc, const Point& x);

  std::vector<Arc> arcs_;
};

}  // namespace sprekk::fine_fracture
