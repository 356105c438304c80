// How rotations move the points of a rigid body.
#pragma once

#include "framework/types.hpp"

namespace sprekk {

/// Independent rotations of a rigid body: one in a plane, three in space. With `dimension` translations these are all
/// of its motions.
inline constexpr int rigid_rotations = dimension * (dimension - 1) / 2;

/// The displacement of a point by small rotations about the origin, a column each: by a unit angle from one axis
/// towards a later one. In a plane (−y, x). Has the unit of `arm`.
inline Eigen::Matrix<double, dimension, rigid_rotations> rotated(const Point& arm) {
  Eigen::Matrix<double, dimension, rigid_rotations> motions = decltype(motions)::Zero();
  int rotation = 0;
  for (int from = 0; from < dimension; ++from)
    for (int to = from + 1; to < dimension; ++to, ++rotation) {
      motions(from, rotation) = -arm[to];
      motions(to, rotation) = arm[from];
    }
  return motions;
}

}  // namespace sprekk
