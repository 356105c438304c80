#include "framework/meshing/validate_geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "framework/mesh/medium.hpp"
#include "framework/mesh/plane/planar.hpp"
#include "framework/mesh/search/segment_tree.hpp"
#include "framework/meshing/distinct_text.hpp"
#include "framework/meshing/size_field.hpp"

namespace sprekk {
namespace {

constexpr double most_cells = 20e6;

using Problems = std::vector<std::string>;

std::string number(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string box_text(const Box& box) {
  return "the box is x from " + number(box.low.x()) + " to " + number(box.high.x()) + " m, y from " +
         number(box.low.y()) + " to " + number(box.high.y()) + " m";
}

/// The distance from a point in the box to the nearest side; negative outside of the box.
double depth(const Box& box, const Point& x) { return std::min((x - box.low).minCoeff(), (box.high - x).minCoeff()); }

std::vector<Segment> segments_of(const std::vector<Point>& points, bool closed = false) {
  std::vector<Segment> segments;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) segments.push_back({points[i], points[i + 1]});
  if (closed) segments.push_back({points.back(), points.front()});
  return segments;
}

void validate_box(const Box& box) {
  if (!box.low.allFinite() || !box.high.allFinite()) {
    throw InputError(box.origin, "the box has an end that is no finite number", box_text(box));
  }
  for (int i = 0; i < dimension; ++i) {
    const std::string axis(1, "xy"[i]);
    if (box.high[i] <= box.low[i]) {
      throw InputError(box.origin, "the box is empty along " + axis,
                       "it reaches from " + number(box.low[i]) + " to " + number(box.high[i]) + " m",
                       "write the smaller " + axis + " first");
    }
  }
}

void validate_points(const Box& box, const std::vector<Point>& points, const std::string& what, const Origin& origin) {
  for (const Point& point : points) {
    if (!point.allFinite()) throw InputError(origin, what + " has a point that is no finite number", to_text(point));
    if (depth(box, point) < -point_tolerance(box)) {
      throw InputError(origin, what + " leaves the box",
                       "its point " + distinct_text(point, point.cwiseMax(box.low).cwiseMin(box.high)) +
                           " lies outside; " + box_text(box),
                       "move the point or enlarge the box");
    }
  }
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

void validate_size(const std::string& name, std::optional<double> size, const Origin& origin) {
  if (size && !(*size > 0 && std::isfinite(*size))) {
    throw InputError(origin, "mesh size '" + name + "' is " + number(*size) + " m", "edge lengths are positive");
  }
}

template <class Item>
void validate_names(const std::vector<Item>& items, const std::string& kind, Problems& problems) {
  std::map<std::string, const Item*> known;
  for (const Item& item : items) {
    const auto [first, is_new] = known.emplace(item.name, &item);
    if (is_new) continue;
    problems.push_back(InputError(item.origin, "two " + kind + "s are called '" + item.name + "'",
                                  "the other one is at " + first->second->origin.text(),
                                  "give one of them another name")
                           .what());
  }
}

/// Adds what `validate` throws.
template <class Validate>
void collect(Problems& problems, const Validate& validate) {
  try {
    validate();
  } catch (const InputError& error) {
    problems.push_back(error.what());
  }
}

/// Adds the problems of fractures that lie near one another.
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

void validate_options(const MeshOptions& options) {
  validate_size("size", options.size, options.origin);
  validate_size("fracture_size", options.fracture_size, options.origin);
  validate_size("tip_size", options.tip_size, options.origin);
  validate_size("gap_size", options.gap_size, options.origin);
  if (!(options.gap_edges >= 0 && std::isfinite(options.gap_edges))) {
    throw InputError(options.origin, "mesh gap_edges is " + number(options.gap_edges), "it must be 0 or more",
                     "0 leaves narrow gaps alone");
  }
  constexpr double steepest = 2, most_distorted = 0.4;  // beyond, cells are bad, or may turn over
  if (!(options.growth > 0 && options.growth <= steepest)) {
    throw InputError(options.origin, "mesh growth is " + number(options.growth),
                     "it must be greater than 0 and at most 2", "0.3 is usual");
  }
  if (!(options.distortion >= 0 && options.distortion <= most_distorted)) {
    throw InputError(options.origin, "mesh distortion is " + number(options.distortion), "it must be from 0 to 0.4");
  }
  if (std::min(options.cells[0], options.cells[1]) < 0) {
    throw InputError(options.origin, "the mesh has a negative number of cells along a side");
  }
}

void validate_cell_count(const Geometry& geometry, const MeshOptions& options) {
  double estimate = 0;
  if (options.kind == MeshOptions::Kind::structured) {
    estimate = options.shape == MeshOptions::Shape::triangles ? 2 : 1;
    for (int i = 0; i < dimension; ++i) {
      estimate *= options.cells[i] > 0 ? options.cells[i] : geometry.box.size()[i] / far_size(geometry, options);
    }
  } else {
    estimate = SizeField(geometry, options).estimated_triangles();
  }
  if (estimate > most_cells) {
    MeshOptions without_gaps = options;
    without_gaps.gap_edges = 0;
    if (options.kind == MeshOptions::Kind::unstructured &&
        SizeField(geometry, without_gaps).estimated_triangles() <= most_cells) {
      throw InputError(options.origin, "narrow gaps ask for about " + number(estimate) + " triangles",
                       "at most " + number(most_cells) + " are made",
                       "choose a larger gap_size, or gap_edges: 0 to leave gaps alone");
    }
    const bool has_rectangles =
        options.kind == MeshOptions::Kind::structured && options.shape == MeshOptions::Shape::quadrilaterals;
    throw InputError(
        options.origin,
        "the mesh sizes ask for about " + number(estimate) + (has_rectangles ? " rectangles" : " triangles"),
        "at most " + number(most_cells) + " are made", "choose larger sizes; " + box_text(geometry.box));
  }
}

}  // namespace

void validate_geometry(const Geometry& geometry, const MeshOptions& options) {
  validate_options(options);
  if (geometry.is_imported()) {
    if (!geometry.fractures.empty() || !geometry.regions.empty()) {
      throw InputError(geometry.file_origin, "fractures and regions are given together with a mesh file",
                       "the file holds them as groups of curves and surfaces", "draw them into the file");
    }
    if (options.kind == MeshOptions::Kind::structured) {
      throw InputError(options.origin, "a mesh file cannot become a structured mesh");
    }
    if (options.shape == MeshOptions::Shape::quadrilaterals) {
      throw InputError(options.origin, "the cells of a mesh file keep their shape",
                       "a file may hold triangles and quadrilaterals", "leave shape away");
    }
    return;
  }
  validate_box(geometry.box);
  Problems problems;
  validate_names(geometry.fractures, "fracture", problems);
  validate_names(geometry.regions, "region", problems);
  const double snap = geometry.snap.value_or(0);
  for (const FractureGeometry& fracture : geometry.fractures) {
    collect(problems, [&] {
      validate_size("size", fracture.size, fracture.origin);
      validate_fracture(geometry.box, fracture, snap);
    });
  }
  validate_pairs(geometry, problems);
  for (const RegionGeometry& region : geometry.regions)
    collect(problems, [&] { validate_region(geometry.box, region); });
  if (!problems.empty()) throw InputError(problems);
  validate_cell_count(geometry, options);
}

}  // namespace sprekk
