#include "framework/triangulation/smooth_triangles.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "framework/mesh/face_table.hpp"
#include "framework/mesh/plane/planar.hpp"

namespace sprekk {
namespace {

class Smoother {
 public:
  Smoother(std::vector<Point>& points, std::vector<Ring>& triangles, const std::vector<char>& is_free)
      : points_(points), triangles_(triangles), is_free_(is_free) {}

  void flip() {
    const FaceTable edges(points_, triangles_);
    std::vector<char> is_stale(triangles_.size(), false);
    for (int edge = 0; edge < edges.size(); ++edge) {
      const auto [a, c] = edges.nodes(edge);
      if (edges.is_outer(edge) || (!is_free_[a] && !is_free_[c])) continue;
      const auto [one, other] = edges.cells(edge);
      if (is_stale[one] || is_stale[other]) continue;
      const int b = opposite(other, a, c), d = opposite(one, a, c);  // a, b, c, d is counter-clockwise
      constexpr double worthwhile = 1e-3;                            // rad: smaller gains change nothing
      if (std::min(shape(a, b, d), shape(b, c, d)) <= std::min(shape(a, b, c), shape(c, d, a)) + worthwhile) continue;
      triangles_[one] = {a, b, d};
      triangles_[other] = {b, c, d};
      is_stale[one] = is_stale[other] = true;
    }
  }

  void move() {
    std::vector<int> first(points_.size() + 1, 0);
    for (const Ring& triangle : triangles_)
      for (const int point : triangle) ++first[point + 1];
    for (std::size_t i = 0; i < points_.size(); ++i) first[i + 1] += first[i];
    std::vector<int> around(first.back()), next(first.begin(), first.end() - 1);
    for (std::size_t i = 0; i < triangles_.size(); ++i)
      for (const int point : triangles_[i]) around[next[point]++] = static_cast<int>(i);
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (is_free_[i]) move(static_cast<int>(i), &around[first[i]], first[i + 1] - first[i]);
  }

 private:
  /// The shape of a triangle: 1 for equal sides, 0 for no area, negative when clockwise.
  double shape(int a, int b, int c) const {
    const Point ab = points_[b] - points_[a], bc = points_[c] - points_[b], ca = points_[a] - points_[c];
    return -2 * std::numbers::sqrt3 * cross(ab, ca) / (ab.squaredNorm() + bc.squaredNorm() + ca.squaredNorm());
  }

  int opposite(int triangle, int p, int q) const {
    for (const int point : triangles_[triangle])
      if (point != p && point != q) return point;
    return p;
  }

  double worst(const int* around, int count) const {
    double worst = std::numeric_limits<double>::infinity();
    for (int k = 0; k < count; ++k) {
      const Ring& t = triangles_[around[k]];
      worst = std::min(worst, shape(t[0], t[1], t[2]));
    }
    return worst;
  }

  void move(int point, const int* around, int count) {
    if (count == 0) return;
    const double before = worst(around, count);
    const Point start = points_[point];
    // Each neighbour is a corner of two of the triangles, and counts twice.
    Point mean = Point::Zero();
    for (int k = 0; k < count; ++k)
      for (const int other : triangles_[around[k]])
        if (other != point) mean += points_[other];
    mean /= 2.0 * count;
    for (const double part : {1.0, 0.5}) {
      points_[point] = start + part * (mean - start);
      if (worst(around, count) >= before) return;
    }
    points_[point] = start;
  }

  std::vector<Point>& points_;
  std::vector<Ring>& triangles_;
  const std::vector<char>& is_free_;
};

}  // namespace

void smooth_triangles(std::vector<Point>& points, std::vector<Ring>& triangles, const std::vector<char>& is_free,
                      int rounds) {
  Smoother smoother(points, triangles, is_free);
  for (int i = 0; i < rounds; ++i) {
    smoother.flip();
    smoother.move();
  }
}

}  // namespace sprekk
