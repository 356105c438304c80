#include "framework/meshing/plane/arrangement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "framework/mesh/mesh.hpp"
#include "framework/mesh/search/plane/segment_tree.hpp"

namespace sprekk {
namespace {

/// Points of which none is nearer to another than a tolerance.
class DistinctPoints {
 public:
  DistinctPoints(double tolerance, std::vector<Point>& points) : tolerance_(tolerance), points_(points) {}

  /// The first point within the tolerance of x, which is added if there is none.
  int number(const Point& x) {
    const auto [i, j] = bucket(x);
    int first = none;
    for (const long di : {-1, 0, 1})
      for (const long dj : {-1, 0, 1}) {
        const auto found = buckets_.find({i + di, j + dj});
        if (found == buckets_.end()) continue;
        for (const int other : found->second)
          if ((first == none || other < first) && (points_[other] - x).norm() < tolerance_) first = other;
      }
    if (first != none) return first;
    points_.push_back(x);
    buckets_[{i, j}].push_back(static_cast<int>(points_.size()) - 1);
    return static_cast<int>(points_.size()) - 1;
  }

 private:
  std::pair<long, long> bucket(const Point& x) const {
    return {static_cast<long>(std::floor(x.x() / tolerance_)), static_cast<long>(std::floor(x.y() / tolerance_))};
  }

  const double tolerance_;
  std::vector<Point>& points_;
  std::map<std::pair<long, long>, std::vector<int>> buckets_;  ///< squares as wide as the tolerance
};

}  // namespace

Arrangement arrange(const std::vector<Segment>& segments, double tolerance) {
  Arrangement arrangement;
  auto& points = arrangement.points;
  DistinctPoints distinct(tolerance, points);
  for (const Segment& segment : segments) {
    const int from = distinct.number(segment.from);
    arrangement.chains.push_back({from, distinct.number(segment.to)});
  }
  const SegmentTree near_segments(segments);
  for (int i = 0; i < static_cast<int>(segments.size()); ++i) {
    for (const int j : near_segments.near(segments[i], tolerance)) {
      Point crossing;
      if (j < i && cross_inside(segments[i], segments[j], crossing)) distinct.number(crossing);
    }
  }
  std::vector<Segment> places;
  for (const Point& point : points) places.push_back({point, point});
  const SegmentTree near_points(places);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    auto& chain = arrangement.chains[i];
    const Point from = segments[i].from, along = segments[i].to - from;
    const int first = chain[0], last = chain[1];
    for (const int p : near_points.near(segments[i], tolerance)) {
      if (p != first && p != last && distance(points[p], segments[i]) < tolerance) chain.push_back(p);
    }
    std::sort(chain.begin(), chain.end(),
              [&](int a, int b) { return (points[a] - from).dot(along) < (points[b] - from).dot(along); });
  }
  return arrangement;
}

std::vector<Segment> all_segments(const Geometry& geometry) {
  const auto [low, high] = std::pair(geometry.box.low, geometry.box.high);
  const std::array<Point, box_sides.size()> corners = {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < corners.size(); ++i) segments.push_back({corners[i], corners[(i + 1) % corners.size()]});
  for (const FractureGeometry& fracture : geometry.fractures) {
    for (std::size_t i = 0; i + 1 < fracture.points.size(); ++i) {
      segments.push_back({fracture.points[i], fracture.points[i + 1]});
    }
  }
  for (const RegionGeometry& region : geometry.regions) {
    const auto& polygon = region.polygon;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      segments.push_back({polygon[i], polygon[(i + 1) % polygon.size()]});
    }
  }
  return segments;
}

}  // namespace sprekk
