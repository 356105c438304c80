#include "components/fine_fracture/quarter_point/mesh/rounded_geometry.hpp"

#include <algorithm>
#include <numbers>

#include "components/fine_fracture/fine_level/outline.hpp"
#include "framework/mesh/plane/planar.hpp"

namespace sprekk::fine_fracture {
namespace {

constexpr int radii_in_octave = 16;       ///< rounded radii of rosettes: to 4 %; bends to 1.4 degrees
constexpr double lengths_in_radii = 4;    ///< local lengths are no longer than this, in rounded radii
constexpr int bends_in_right_angle = 64;  ///< rounded bends

DrawingFrame frame_of(const FineGeometry& geometry, const Point& anchor) {
  std::vector<Segment> lines;
  for (const CrackPath& crack : geometry.cracks)
    for (std::size_t i = 0; i + 1 < crack.points.size(); ++i) lines.push_back({crack.points[i], crack.points[i + 1]});
  return drawing_frame(outline_extent(geometry.outline), lines, anchor);
}

/// The places of a geometry and the lines between them.
class Places {
 public:
  explicit Places(const FineGeometry& geometry) : geometry_(geometry), tolerance_(outline_tolerance(geometry.outline)) {
    for (const Point& x : geometry.outline) corners_.push_back(place(x));
    for (const CrackPath& crack : geometry.cracks) {
      std::vector<int>& places = cracks_.emplace_back();
      for (const Point& x : crack.points) places.push_back(place(x));
      for (std::size_t i = 0; i + 1 < places.size(); ++i) lines_.push_back({places[i], places[i + 1]});
    }
    draw_outline();
  }

  FineGeometry rounded(double largest) const {
    std::vector<Point> points = rounded_points(points_, lines_, largest);
    for (const auto& [point, edge] : on_edges_) {
      const Point &from = points[corners_[edge]], to = points[corners_[(edge + 1) % corners_.size()]];
      const Point along = to - from;
      points[point] = from + (points[point] - from).dot(along) / along.squaredNorm() * along;
    }
    FineGeometry result = geometry_;
    for (std::size_t i = 0; i < corners_.size(); ++i) result.outline[i] = points[corners_[i]];
    for (std::size_t c = 0; c < cracks_.size(); ++c)
      for (std::size_t i = 0; i < cracks_[c].size(); ++i) result.cracks[c].points[i] = points[cracks_[c][i]];
    return result;
  }

 private:
  int place(const Point& x) {
    for (std::size_t i = 0; i < points_.size(); ++i)
      if ((points_[i] - x).norm() <= tolerance_) return static_cast<int>(i);
    points_.push_back(x);
    return static_cast<int>(points_.size()) - 1;
  }

  /// Ends of cracks divide the edges of the outline.
  void draw_outline() {
    const int count = static_cast<int>(corners_.size());
    for (int edge = 0; edge < count; ++edge) {
      const Segment line = outline_edge(geometry_.outline, edge);
      std::vector<std::pair<double, int>> stops;
      for (int p = 0; p < static_cast<int>(points_.size()); ++p) {
        if (distance(points_[p], line) > 2 * tolerance_) continue;
        stops.emplace_back((points_[p] - line.from).dot(line.to - line.from), p);
        if (std::ranges::count(corners_, p) == 0) on_edges_.emplace_back(p, edge);
      }
      std::ranges::sort(stops);
      for (std::size_t i = 0; i + 1 < stops.size(); ++i) lines_.push_back({stops[i].second, stops[i + 1].second});
    }
  }

  const FineGeometry& geometry_;
  double tolerance_;
  std::vector<Point> points_;
  std::vector<std::array<int, 2>> lines_;
  std::vector<int> corners_;
  std::vector<std::vector<int>> cracks_;
  std::vector<std::pair<int, int>> on_edges_;  ///< points on an edge of the outline, and the edge
};

}  // namespace

std::vector<std::vector<double>> bends_of(const FineGeometry& geometry) {
  std::vector<std::vector<double>> bends;
  for (const CrackPath& crack : geometry.cracks) {
    bends.emplace_back(crack.points.size(), 0.0);
    for (std::size_t i = 1; i + 1 < crack.points.size(); ++i) {
      const Point a = crack.points[i] - crack.points[i - 1], b = crack.points[i + 1] - crack.points[i];
      bends.back()[i] = std::abs(std::atan2(cross(a, b), a.dot(b)));
    }
  }
  return bends;
}

RoundedGeometry rounded_geometry(const FineGeometry& geometry, const std::vector<TipRoom>& rooms, const Point& anchor) {
  RoundedGeometry result;
  result.frame = frame_of(geometry, anchor);
  const double scale = result.frame.unit();
  FineGeometry inward = geometry;
  for (Point& x : inward.outline) x = result.frame.inward(x);
  for (CrackPath& crack : inward.cracks)
    for (Point& x : crack.points) x = result.frame.inward(x);
  double largest = outline_extent(inward.outline);
  for (const TipRoom& room : rooms) {
    TipRoom& rounded_room = result.rooms.emplace_back(room);
    rounded_room.radius = rounded_in_octave(room.radius / scale, radii_in_octave);
    largest = std::min(largest, lengths_in_radii * rounded_room.radius);
  }
  result.geometry = Places(inward).rounded(largest);
  for (TipRoom& room : result.rooms) {
    const std::vector<Point>& points = result.geometry.cracks[room.crack].points;
    const std::size_t n = points.size();
    room.position = room.is_last ? points.back() : points.front();
    room.direction = (room.position - (room.is_last ? points[n - 2] : points[1])).normalized();
  }
  result.bends = bends_of(geometry);
  constexpr double spacing = std::numbers::pi / 2 / bends_in_right_angle;
  for (std::vector<double>& bends : result.bends)
    for (double& bend : bends) bend = rounded(bend, spacing);
  return result;
}

}  // namespace sprekk::fine_fracture
