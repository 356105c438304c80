// The frame of the end of a fracture: in which direction and on which side of the fracture points lie.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// Polar coordinates around an end, for fields that differ on both sides of the fracture.
///
/// `side` says on which side of the fracture a point near it is taken to lie: +1 left of the direction in which the
/// fracture points, -1 right of it, 0 where the position of the point decides.
class EndFrame {
 public:
  /// `end`: a node that is the end of a fracture (is_fracture_end).
  EndFrame(const Mesh& mesh, int end);

  /// +1 or -1: the side of the fracture, which may bend, and ahead of the end that of the line through the last wall.
  int side_of(const Point& x) const;
  int side_of_wall(const Mesh& mesh, int face) const;  ///< +1 or -1
  /// That of its wall, and for a cell without a wall that of its centre; 0 for one that has the end as a corner: it
  /// lies ahead of the walls, and positions decide.
  int side_of_cell(const Mesh& mesh, int cell) const;

  /// Polar coordinates around the end.
  struct Polar {
    double radius;  ///< m
    double angle;   ///< rad, from ahead of the end, continued beyond +-pi
  };
  Polar polar(const Point& x, int side) const;

  const Point& origin() const { return origin_; }  ///< m
  double size() const { return size_; }            ///< m, of the wall at the end
  /// Unit vectors as columns: the direction ahead of the end, and this direction turned by +90 degrees.
  const Eigen::Matrix2d& axes() const { return axes_; }

 private:
  int end_;
  Point origin_;
  double size_ = 1;
  Eigen::Matrix2d axes_;
  int fracture_ = none;
  std::vector<Point> line_;  ///< m, of the fracture, from the end backwards; it goes straight on behind its last point
};

}  // namespace sprekk
