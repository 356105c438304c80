// A canonical form of the input of a mesh generator, so that the mesh depends on the shape alone.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "framework/types.hpp"

namespace sprekk {

/// Points and lines between them, numbered from 0, in a frame and an order that follow from their shape. Drawings that
/// differ by a shift, by half a turn, or by the order and direction of their parts become the same to the last bit
/// (except where rounding decides), and so their meshes are the same. Point-symmetric growth therefore stays
/// point-symmetric.
///
/// The frame has its origin in the middle of the points, and the drawing has a size between 1 and 2 in it. The scale is
/// a power of two, so that scaling rounds nothing. Coordinates are multiples of 2^-32, as mesh_region() requires.
struct CanonicalDrawing {
  /// `points` (m) has at least two different points; each line joins two of them.
  CanonicalDrawing(const std::vector<Point>& points, const std::vector<std::array<int, 2>>& lines);

  std::vector<Point> points;              ///< ascending, in the frame
  std::vector<std::array<int, 2>> lines;  ///< ascending, each from its lower to its higher point
  std::vector<int> point_number;          ///< per given point: its number in `points`
  std::vector<int> line_number;           ///< per given line: its number in `lines`
  std::vector<bool> is_reversed;          ///< per given line: whether it runs the other way in `lines`

  Point inward(const Point& x) const { return (x - origin_) / scale_; }
  Point outward(const Point& x) const { return origin_ + scale_ * x; }
  double scale() const { return std::abs(scale_); }  ///< m per unit of the frame

 private:
  Point origin_;
  double scale_;  ///< m, negative for half a turn
};

}  // namespace sprekk
