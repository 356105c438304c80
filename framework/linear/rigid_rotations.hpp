// How rotations move the points of a rigid body.
#pragma once

#include "framework/types.hpp"

namespace sprekk {

/// Independent rotations of a rigid body: one in a plane, three in space. With `axes` translations these are all of its
/// motions.
constexpr int rigid_rotations(int axes) { return axes * (axes - 1) / 2; }

inline constexpr int most_axes = 3;  ///< dimensions of space
inline constexpr int most_rotations = rigid_rotations(most_axes);

/// A place, or a direction: two coordinates in a plane, three in space.
using Coordinates = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_axes, 1>;
using Rotations = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_axes, most_rotations>;

/// The displacement of a point by small rotations about the origin, a column each: by a unit angle from one axis
/// towards a later one. In a plane (−y, x). Has the unit of `arm`.
inline Rotations rotated(const Coordinates& arm) {
  const int axes = static_cast<int>(arm.size());
  Rotations motions = Rotations::Zero(axes, rigid_rotations(axes));
  int rotation = 0;
  for (int from = 0; from < axes; ++from)
    for (int to = from + 1; to < axes; ++to, ++rotation) {
      motions(from, rotation) = -arm[to];
      motions(to, rotation) = arm[from];
    }
  return motions;
}

}  // namespace sprekk
