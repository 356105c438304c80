// The rim of an elliptical fracture, and how near it is to others.
#pragma once

#include <array>
#include <functional>

#include "framework/meshing/geometry.hpp"
#include "framework/meshing/space/flat_shape.hpp"

namespace sprekk {

/// An ellipse in space with exact distances, m.
class Rim {
 public:
  explicit Rim(const Ellipse& ellipse);

  Point at(double angle) const;  ///< from the first half axis to the second
  /// How far a place in the plane of the ellipse is outside of it; negative inside.
  double outside(const Point& x) const;
  double distance(const Point& x) const;          ///< to the rim
  double distance_to_disc(const Point& x) const;  ///< to the nearest point inside of the rim
  /// The places of the rim that are farthest on both sides of a plane with this normal.
  std::array<Point, 2> farthest_from(const Point& normal) const;
  /// Calls use(place, value) at each local minimum along the rim that may be less than `reach` (m). The function (m)
  /// must change by no more than the distance between two places.
  void for_each_minimum(double reach, const std::function<double(const Point&)>& function,
                        const std::function<void(const Point& at, double value)>& use) const;

 private:
  double height(const Point& x) const { return (x - center_).dot(normal_); }

  Point center_, one_axis_, other_axis_, normal_;
  double longer_, shorter_;  ///< half axes
};

}  // namespace sprekk
