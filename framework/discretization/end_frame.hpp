// The frame of the end of a fracture: in which direction and on which side of the fracture points lie.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// Polar coordinates around an end, for fields that differ on both sides of the fracture. In space they lie in the
/// plane across the rim, which has an edge on either side of the end: coordinates are those of the edge that is nearer.
///
/// `side` says on which side of the fracture a point near it is taken to lie: +1 left of the direction in which the
/// fracture points, -1 right of it, 0 where the position of the point decides.
class EndFrame {
 public:
  /// `end`: a node that is the end of a fracture (is_fracture_end).
  EndFrame(const Mesh& mesh, int end);

  /// +1 or -1: the side of the fracture, which in a plane may bend, and ahead of the end that of the line or plane
  /// through the last wall.
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
  Polar polar(const Point& x, int side) const { return polar(x, side, axes_near(x)); }
  Polar polar(const Point& x, int side, const Tensor& axes) const;

  const Point& origin() const { return origin_; }  ///< m
  double size() const { return size_; }            ///< m, of the wall at the end, from there backwards
  /// Unit vectors as columns: the direction ahead of the end, that to its left, and in space that along the rim; in
  /// space those of the first edge.
  const Tensor& axes() const { return axes_[0]; }
  /// In space those of the edge of the rim to which x belongs.
  const Tensor& axes_near(const Point& x) const;

 private:
  int end_;
  Point origin_;
  double size_ = 1;
  std::array<Tensor, dimension - 1> axes_;  ///< in space of both edges of the rim
  bool bends_back_ = true;                  ///< in space: whether each edge lies behind the line of the other one
  int fracture_ = none;
  /// In a plane, m: of the fracture, from the end backwards; it goes straight on behind its last point.
  std::vector<Point> line_;
};

}  // namespace sprekk
