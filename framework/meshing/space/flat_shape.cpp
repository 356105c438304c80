#include "framework/meshing/space/flat_shape.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sprekk {
namespace {

constexpr int corners_of_ellipse = 96;  // within a 2000th of its half axes, fine for distances and sizes of cells

std::vector<Point> corners_of(const FractureGeometry& fracture) {
  if (!fracture.ellipse) return fracture.points;
  const auto& [center, one, other] = *fracture.ellipse;
  std::vector<Point> corners;
  for (int k = 0; k < corners_of_ellipse; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners_of_ellipse;
    corners.push_back(center + std::cos(angle) * one + std::sin(angle) * other);
  }
  return corners;
}

double distance_in_plane(const FlatPoint& x, const FlatPoint& from, const FlatPoint& to) {
  const FlatPoint along = to - from;
  const double square = along.squaredNorm();
  const double share = square > 0 ? std::clamp((x - from).dot(along) / square, 0.0, 1.0) : 0;
  return (x - from - share * along).norm();
}

}  // namespace

FlatShape::FlatShape(const FractureGeometry& fracture) : FlatShape(corners_of(fracture)) {}

FlatShape::FlatShape(const std::vector<Point>& corners) : corners_(corners) {
  for (const Point& corner : corners_) origin_ += corner / static_cast<double>(corners_.size());
  Point area = Point::Zero();
  for (const auto& [from, to] : edges_of(corners_)) area += 0.5 * (from - origin_).cross(to - origin_);
  area_ = area.norm();
  axes_[2] = area_ > 0 ? Point(area / area_) : Point::UnitZ();
  axes_[0] = axes_[2].unitOrthogonal();
  axes_[1] = axes_[2].cross(axes_[0]);
  for (const Point& corner : corners_) outline_.push_back(in_plane(corner));
}

double FlatShape::farthest_from_plane() const {
  double farthest = 0;
  for (const Point& corner : corners_) farthest = std::max(farthest, std::abs(height(corner)));
  return farthest;
}

bool FlatShape::contains(const FlatPoint& x, double margin) const {
  bool is_in = false;
  for (std::size_t i = 0; i < outline_.size(); ++i) {
    const FlatPoint &from = outline_[i], &to = outline_[(i + 1) % outline_.size()];
    if (margin != 0 && distance_in_plane(x, from, to) < std::abs(margin)) return margin < 0;
    if ((from.y() > x.y()) != (to.y() > x.y()) &&
        x.x() < from.x() + (x.y() - from.y()) / (to.y() - from.y()) * (to.x() - from.x()))
      is_in = !is_in;
  }
  return is_in;
}

double FlatShape::distance(const Point& x) const {
  const FlatPoint flat = in_plane(x);
  if (contains(flat, 0)) return std::abs(height(x));
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline_.size(); ++i)
    nearest = std::min(nearest, distance_in_plane(flat, outline_[i], outline_[(i + 1) % outline_.size()]));
  return std::hypot(nearest, height(x));
}

Point FlatShape::low() const {
  Point low = corners_[0];
  for (const Point& corner : corners_) low = low.cwiseMin(corner);
  return low;
}

Point FlatShape::high() const {
  Point high = corners_[0];
  for (const Point& corner : corners_) high = high.cwiseMax(corner);
  return high;
}

std::vector<Line> edges_of(const std::vector<Point>& corners) {
  std::vector<Line> edges;
  for (std::size_t i = 0; i < corners.size(); ++i) edges.push_back({corners[i], corners[(i + 1) % corners.size()]});
  return edges;
}

Point nearest_point(const Point& x, const Line& line) {
  const Point along = line.to - line.from;
  const double square = along.squaredNorm();
  return line.from + (square > 0 ? std::clamp((x - line.from).dot(along) / square, 0.0, 1.0) : 0) * along;
}

std::pair<Point, Point> nearest_points(const Line& one, const Line& other) {
  // Either inside of both, or at an end of one.
  std::pair<Point, Point> nearest{one.from, nearest_point(one.from, other)};
  const auto consider = [&](const Point& a, const Point& b) {
    if ((a - b).norm() < (nearest.first - nearest.second).norm()) nearest = {a, b};
  };
  consider(one.to, nearest_point(one.to, other));
  consider(nearest_point(other.from, one), other.from);
  consider(nearest_point(other.to, one), other.to);
  const Point u = one.to - one.from, v = other.to - other.from, w = one.from - other.from;
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), determinant = uu * vv - uv * uv;
  if (determinant > 0) {
    const double s = (uv * v.dot(w) - vv * u.dot(w)) / determinant, t = (uu * v.dot(w) - uv * u.dot(w)) / determinant;
    if (s > 0 && s < 1 && t > 0 && t < 1) consider(one.from + s * u, other.from + t * v);
  }
  return nearest;
}

}  // namespace sprekk
