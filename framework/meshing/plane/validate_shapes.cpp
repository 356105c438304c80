#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "framework/mesh/medium.hpp"
#include "framework/mesh/plane/planar.hpp"
#include "framework/mesh/search/plane/segment_tree.hpp"
#include "framework/meshing/plane/size_field.hpp"
#include "framework/meshing/validate_shapes.hpp"

namespace sprekk {
namespace {

std::vector<Segment> segments_of(const std::vector<Point>& points, bool closed = false) {
  std::vector<Segment> segments;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) segments.push_back({points[i], points[i + 1]});
  if (closed) segments.push_back({points.back(), points.front()});
  return segments;
}

/// Whether a segment folds back onto the segment before it, with which it shares a point.
bool fold_back(const Segment& first, const Segment& second, double tolerance) {
  return distance(second.to, first) < tolerance || distance(first.from, second) < tolerance;
}

/// Two segments of a path that meet where they should not.
struct SelfContact {
  std::size_t one, other;  ///< counted from 1
  Point at;
  bool is_crossing;
};

std::optional<SelfContact> self_contact(const std::vector<Segment>& segments, bool closed, double tolerance) {
  const std::size_t n = segments.size();
  const SegmentTree tree(segments);
  for (std::size_t i = 0; i < n; ++i) {
    for (const std::size_t j : tree.near(segments[i], tolerance)) {
      if (j <= i) continue;
      const bool wraps = closed && i == 0 && j == n - 1;
      const bool touches = j == i + 1 ? fold_back(segments[i], segments[j], tolerance)
                           : wraps    ? fold_back(segments[j], segments[i], tolerance)
                                      : distance(segments[i], segments[j]) < tolerance;
      if (!touches) continue;
      Point at = segments[j].from;
      const bool is_crossing = cross_inside(segments[i], segments[j], at);
      return SelfContact{i + 1, j + 1, at, is_crossing};
    }
  }
  return std::nullopt;
}

}  // namespace

void validate_fracture(const Box& box, const FractureGeometry& fracture, double snap) {
  const double tolerance = point_tolerance(box);
  const std::string what = "fracture '" + fracture.name + "'";
  const auto& points = fracture.points;
  if (points.size() < 2) {
    throw InputError(fracture.origin, what + " has fewer than two points", "it needs a beginning and an end",
                     "write points: [[x, y], [x, y]]");
  }
  validate_points(box, points, what, fracture.origin);
  const auto segments = segments_of(points);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (segments[i].length() < tolerance) {
      throw InputError(
          fracture.origin, what + " has a segment of length zero",
          "points " + std::to_string(i + 1) + " and " + std::to_string(i + 2) + " are both " + to_text(points[i]),
          "leave one of them out");
    }
    if (depth(box, 0.5 * (points[i] + points[i + 1])) < tolerance) {
      throw InputError(fracture.origin, what + " runs along the boundary", "at " + to_text(points[i]),
                       "move it into the " + medium_name());
    }
  }
  if (const auto contact = self_contact(segments, false, tolerance)) {
    throw InputError(
        fracture.origin, what + " meets itself",
        fmt::format("its segments {} and {} meet near {}", contact->one, contact->other, to_text(contact->at)),
        "leave a gap or make it two fractures");
  }
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    if (depth(box, points[i]) < std::max(tolerance, snap)) {
      throw InputError(fracture.origin, what + " touches the boundary between its ends", "at " + to_text(points[i]),
                       "end it there");
    }
  }
}

namespace {

/// The common points of two segments: ends that lie on both, and their crossing.
std::vector<Point> common_points(const Segment& one, const Segment& other, double tolerance) {
  std::vector<Point> common;
  for (const Point& end : {one.from, one.to, other.from, other.to}) {
    if (std::max(distance(end, one), distance(end, other)) < tolerance) common.push_back(end);
  }
  Point crossing;
  if (common.empty() && cross_inside(one, other, crossing)) common.push_back(crossing);
  return common;
}

/// Throws InputError if two fractures overlap, or meet where they may not. `segments`: pairs of one of each that lie
/// near one another.
void validate_pair(const Box& box, const FractureGeometry& a, const FractureGeometry& b,
                   const std::vector<std::pair<Segment, Segment>>& segments, double snap) {
  const double tolerance = point_tolerance(box);
  const auto refuse = [&](const std::string& how, const Point& where, const std::string& why, const std::string& hint) {
    throw InputError(b.origin, "fracture '" + b.name + "' " + how + " fracture '" + a.name + "' at " + to_text(where),
                     why + "; '" + a.name + "' is at " + a.origin.text(), hint);
  };
  for (const auto& [one, other] : segments) {
    const std::vector<Point> common = common_points(one, other, tolerance);
    for (const Point& where : common) {
      if ((where - common.front()).norm() > tolerance)
        refuse("overlaps", where, "fractures may cross and touch, but not share a line", "end one where they meet");
      if (depth(box, where) < std::max(tolerance, snap))
        refuse("meets", where, "that is on the outer boundary, where fractures may not meet",
               "let them meet inside of the box or leave a gap");
    }
  }
}

bool are_on_a_line(const std::vector<Point>& points, double tolerance) {
  const Point& first = points.front();
  const Point farthest = *std::ranges::max_element(points, {}, [&](const Point& x) { return (x - first).norm(); });
  return std::ranges::all_of(points, [&](const Point& x) { return distance(x, {first, farthest}) < tolerance; });
}

}  // namespace

void validate_region(const Box& box, const RegionGeometry& region) {
  const double tolerance = point_tolerance(box);
  const std::string what = "region '" + region.name + "'";
  if (region.name == medium_name()) {
    throw InputError(region.origin, "a polygon is called '" + region.name + "'",
                     "that is the name of everything outside of all polygons", "choose another name");
  }
  if (region.polygon.size() < 3) {
    throw InputError(region.origin, what + " has fewer than three points", "a polygon encloses an area",
                     "write polygon: [[x, y], [x, y], [x, y]]");
  }
  validate_points(box, region.polygon, what, region.origin);
  const auto segments = segments_of(region.polygon, true);
  for (const Segment& segment : segments) {
    if (segment.length() < tolerance) {
      throw InputError(region.origin, what + " has the same point twice in a row", "at " + to_text(segment.from),
                       "the polygon closes itself; leave one of the points out");
    }
  }
  if (are_on_a_line(region.polygon, tolerance)) {
    throw InputError(region.origin, what + " has no area", "its points lie on a line");
  }
  if (const auto contact = self_contact(segments, true, tolerance)) {
    throw InputError(region.origin, what + (contact->is_crossing ? " crosses itself" : " meets itself"),
                     fmt::format("its edges {} and {} {} at {}", contact->one, contact->other,
                                 contact->is_crossing ? "cross" : "meet", to_text(contact->at)),
                     "give its corners in the order in which they go around it");
  }
}

void validate_pairs(const Geometry& geometry, Problems& problems) {
  std::vector<Segment> segments;
  std::vector<int> owner;
  for (std::size_t f = 0; f < geometry.fractures.size(); ++f)
    for (const Segment& segment : segments_of(geometry.fractures[f].points)) {
      if (!segment.from.allFinite() || !segment.to.allFinite()) continue;
      segments.push_back(segment);
      owner.push_back(static_cast<int>(f));
    }
  const SegmentTree tree(segments);
  std::map<std::pair<int, int>, std::vector<std::pair<Segment, Segment>>> near;  // the later fracture first
  for (std::size_t i = 0; i < segments.size(); ++i)
    for (const int j : tree.near(segments[i], point_tolerance(geometry.box)))
      if (owner[j] < owner[i]) near[{owner[i], owner[j]}].emplace_back(segments[j], segments[i]);
  const double snap = geometry.snap.value_or(0);
  for (const auto& [pair, there] : near)
    collect(problems, [&] {
      validate_pair(geometry.box, geometry.fractures[pair.second], geometry.fractures[pair.first], there, snap);
    });
}

double wanted_cells(const Geometry& geometry, const MeshOptions& options) {
  return SizeField(geometry, options).estimated_triangles();
}

}  // namespace sprekk
