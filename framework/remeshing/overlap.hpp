// The common area of the cells of two meshes.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "framework/mesh/ring.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// Corners of a triangle or of a convex quadrilateral, counter-clockwise, in m.
class Corners {
 public:
  Corners(const Point& a, const Point& b, const Point& c) : points_{a, b, c, Point::Zero()}, size_(3) {}
  Corners(const Point& a, const Point& b, const Point& c, const Point& d) : points_{a, b, c, d}, size_(4) {}

  int size() const { return size_; }
  const Point& operator[](int k) const { return points_[k]; }
  const Point& after(int k) const { return points_[k + 1 == size_ ? 0 : k + 1]; }
  const Point* begin() const { return points_.data(); }
  const Point* end() const { return points_.data() + size_; }
  Point* begin() { return points_.data(); }
  Point* end() { return points_.data() + size_; }

 private:
  std::array<Point, 4> points_;
  int size_;
};

/// The corners of a triangle or quadrilateral, in their order.
inline Corners corners_of(const std::vector<Point>& nodes, const Ring& cell) {
  if (cell.size() == 3) return {nodes[cell[0]], nodes[cell[1]], nodes[cell[2]]};
  return {nodes[cell[0]], nodes[cell[1]], nodes[cell[2]], nodes[cell[3]]};
}

/// The area of the intersection of two cells, m^2; exact up to rounding relative to the smaller of them, wherever
/// they lie.
double common_area(const Corners& a, const Corners& b);

/// The area of the intersection of two cells, m^2, and its centre, m; the centre of a where they have no area in
/// common.
struct CommonPart {
  double area = 0;
  Point centre;
};
CommonPart common_part(const Corners& a, const Corners& b);

/// Calls visit(i, j, area) for each pair of a cell of `one` and one of `other` with common area, i ascending, then
/// j ascending. Buckets are used to find pairs: the work is about proportional to the number of pairs.
void for_each_overlap(const std::vector<Corners>& one, const std::vector<Corners>& other,
                      const std::function<void(int, int, double)>& visit);

}  // namespace sprekk
