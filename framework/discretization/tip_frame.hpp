// Where points lie, seen from the tip of a fracture.
#pragma once

#include <Eigen/Core>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// Polar coordinates around a tip, for fields that differ on both sides of the fracture.
///
/// `side` says from where a point near the fracture is seen: +1 from the left of the direction in which the fracture
/// points, -1 from its right, 0 where the point itself tells.
class TipFrame {
 public:
  /// `tip`: a node that is one (see tips_nearby).
  TipFrame(const Mesh& mesh, int tip);

  int side_of(const Point& x) const;                   ///< +1 or -1: of the line through the last wall
  int side_of_wall(const Mesh& mesh, int face) const;  ///< +1 or -1: of the fracture, which may bend
  int side_of_cell(const Mesh& mesh, int cell) const;  ///< of its wall, 0 without one

  struct Polar {
    double radius;  ///< m
    double angle;   ///< rad, from ahead of the tip, continued beyond +-pi
  };
  Polar polar(const Point& x, int side) const;

  const Point& tip() const { return tip_; }  ///< m
  double size() const { return size_; }      ///< m, of the wall at the tip
  /// Columns: ahead of the tip, and that turned by +90 degrees.
  const Eigen::Matrix2d& axes() const { return axes_; }

 private:
  Point tip_;
  double size_ = 1;
  Eigen::Matrix2d axes_;
};

}  // namespace sprekk
