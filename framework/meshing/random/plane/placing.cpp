#include "framework/meshing/random/placing.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "framework/mesh/plane/planar.hpp"
#include "framework/meshing/random/random_fractures.hpp"

namespace sprekk {
namespace {

void append_segments(const std::vector<Point>& points, bool closed, std::vector<Segment>& segments) {
  for (std::size_t i = 0; i + 1 < points.size(); ++i) segments.push_back({points[i], points[i + 1]});
  if (closed) segments.push_back({points.back(), points.front()});
}

/// The acute angle between two lines, rad.
double angle_between(const Segment& a, const Segment& b) {
  const Point u = a.to - a.from, v = b.to - b.from;
  return std::atan2(std::abs(cross(u, v)), std::abs(u.dot(v)));
}

/// The lines that new fractures must keep away from, and where they cross.
class Obstacles {
 public:
  Obstacles(const Geometry& geometry, const RandomFractures& set) : box_(geometry.box), set_(set) {
    for (const FractureGeometry& fracture : geometry.fractures) append_segments(fracture.points, false, lines_);
    for (const RegionGeometry& region : geometry.regions)
      if (!region.polygon.empty()) append_segments(region.polygon, true, lines_);
    Point crossing;
    for (std::size_t i = 0; i < lines_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (cross_inside(lines_[i], lines_[j], crossing)) crossings_.push_back(crossing);
  }

  /// Adds the fracture if it keeps away from all others.
  bool add(const Segment& fracture) {
    for (const Point& end : {fracture.from, fracture.to}) {
      const double depth = std::min((end - box_.low).minCoeff(), (box_.high - end).minCoeff());
      if (depth < set_.least_gap || depth <= 0) return false;
    }
    std::vector<Point> crossings;
    for (const Segment& line : lines_)
      if (!keeps_away(fracture, line, crossings)) return false;
    lines_.push_back(fracture);
    crossings_.insert(crossings_.end(), crossings.begin(), crossings.end());
    return true;
  }

 private:
  bool keeps_away(const Segment& fracture, const Segment& line, std::vector<Point>& crossings) const {
    const double nearest = std::min({distance(fracture.from, line), distance(fracture.to, line),
                                     distance(line.from, fracture), distance(line.to, fracture)});
    if (nearest < set_.least_gap || nearest < point_tolerance(box_)) return false;
    Point crossing;
    if (!cross_inside(fracture, line, crossing)) return true;
    if (angle_between(fracture, line) < set_.least_angle) return false;
    const auto is_near = [&](const Point& other) { return (other - crossing).norm() < set_.least_gap; };
    if (std::ranges::any_of(crossings_, is_near) || std::ranges::any_of(crossings, is_near)) return false;
    crossings.push_back(crossing);
    return true;
  }

  const Box box_;
  const RandomFractures& set_;
  std::vector<Segment> lines_;
  std::vector<Point> crossings_;
};

}  // namespace

std::vector<Point> points_around_middle(const RandomFractures& set, double length, RandomNumbers& directions) {
  const double angle = set.mean_angle + von_mises(directions, set.concentration);
  const Point half = 0.5 * length * Point(std::cos(angle), std::sin(angle));
  return {-half, half};
}

std::function<bool(const std::vector<Point>&)> placer(const Geometry& geometry, const RandomFractures& set) {
  const auto obstacles = std::make_shared<Obstacles>(geometry, set);
  return [obstacles](const std::vector<Point>& points) { return obstacles->add({points[0], points[1]}); };
}

}  // namespace sprekk
