// What a mesh generator is given, so that its mesh depends on the shape alone.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "framework/types.hpp"

namespace sprekk {

/// Points and lines between them, numbered from 0, in a frame and an order that follow from their shape: drawings that
/// differ by a shift, by half a turn, or by the order and direction of their parts become the same to the last bit (but
/// where rounding decides), and so does what a generator makes of them. Growth that is point-symmetric stays so.
///
/// The frame has its origin in the middle of the points, and there a size between 1 and 2; the scale is a power of two,
/// which costs no digits. Places are multiples of 2^-32, as mesh_region() wants them.
struct CanonicalDrawing {
  /// `points` (m) has two different ones at least; each line joins two of them.
  CanonicalDrawing(const std::vector<Point>& points, const std::vector<std::array<int, 2>>& lines);

  std::vector<Point> points;              ///< ascending, in the frame
  std::vector<std::array<int, 2>> lines;  ///< ascending, each from its lower to its higher point
  std::vector<int> point_number;          ///< here, of each given point
  std::vector<int> line_number;           ///< here, of each given line
  std::vector<bool> is_reversed;          ///< per given line: it runs the other way here

  Point inward(const Point& x) const { return (x - origin_) / scale_; }
  Point outward(const Point& x) const { return origin_ + scale_ * x; }
  double scale() const { return std::abs(scale_); }  ///< m per unit of the frame

 private:
  Point origin_;
  double scale_;  ///< m, negative for half a turn
};

}  // namespace sprekk
