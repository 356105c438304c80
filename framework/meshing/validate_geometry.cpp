#include "framework/meshing/validate_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "framework/mesh/medium.hpp"
#include "framework/mesh/planar.hpp"
#include "framework/meshing/size_field.hpp"

namespace sprekk {
namespace {

constexpr double most_cells = 20e6;

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
                       "its point " + to_text(point) + " lies outside; " + box_text(box),
                       "move the point or enlarge the box");
    }
  }
}

/// Whether a segment folds back onto the segment before it, with which it shares a point.
bool fold_back(const Segment& first, const Segment& second, double tolerance) {
  return distance(second.to, first) < tolerance || distance(first.from, second) < tolerance;
}

/// Where a polyline meets itself, as text, or "".
std::string self_contact(const std::vector<Segment>& segments, bool closed, double tolerance) {
  const std::size_t n = segments.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      const bool wraps = closed && i == 0 && j == n - 1;
      const bool touches = j == i + 1 ? fold_back(segments[i], segments[j], tolerance)
                           : wraps    ? fold_back(segments[j], segments[i], tolerance)
                                      : distance(segments[i], segments[j]) < tolerance;
      if (touches) {
        return "its segments " + std::to_string(i + 1) + " and " + std::to_string(j + 1) + " meet near " +
               to_text(segments[j].from);
      }
    }
  }
  return "";
}

void validate_fracture(const Box& box, const FractureGeometry& fracture) {
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
  const std::string contact = self_contact(segments, false, tolerance);
  if (!contact.empty()) {
    throw InputError(fracture.origin, what + " meets itself", contact, "leave a gap or make it two fractures");
  }
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    if (depth(box, points[i]) < tolerance) {
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

void validate_pair(const Box& box, const FractureGeometry& a, const FractureGeometry& b) {
  const double tolerance = point_tolerance(box);
  const auto refuse = [&](const std::string& how, const Point& where, const std::string& why, const std::string& hint) {
    throw InputError(b.origin, "fracture '" + b.name + "' " + how + " fracture '" + a.name + "' at " + to_text(where),
                     why + "; '" + a.name + "' is at " + a.origin.text(), hint);
  };
  for (const Segment& one : segments_of(a.points)) {
    for (const Segment& other : segments_of(b.points)) {
      const std::vector<Point> common = common_points(one, other, tolerance);
      for (const Point& where : common) {
        if ((where - common.front()).norm() > tolerance)
          refuse("overlaps", where, "fractures may cross and touch, but not share a line", "end one where they meet");
        if (depth(box, where) < tolerance)
          refuse("meets", where, "that is on the outer boundary, where fractures may not meet",
                 "let them meet inside of the box or leave a gap");
      }
    }
  }
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
  double longest = 0;
  for (const Segment& segment : segments) {
    longest = std::max(longest, segment.length());
    if (segment.length() < tolerance) {
      throw InputError(region.origin, what + " has the same point twice in a row", "at " + to_text(segment.from),
                       "the polygon closes itself; leave one of the points out");
    }
  }
  if (std::abs(signed_area(region.polygon)) < tolerance * longest) {
    throw InputError(region.origin, what + " has no area", "its points lie on a line");
  }
  const std::string contact = self_contact(segments, true, tolerance);
  if (!contact.empty()) throw InputError(region.origin, what + " meets itself", contact, "make it a simple polygon");
}

void validate_size(const std::string& name, std::optional<double> size, const Origin& origin) {
  if (size && !(*size > 0 && std::isfinite(*size))) {
    throw InputError(origin, "mesh size '" + name + "' is " + number(*size) + " m", "edge lengths are positive");
  }
}

template <class Item>
void validate_names(const std::vector<Item>& items, const std::string& kind) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (items[i].name == items[j].name) {
        throw InputError(items[i].origin, "two " + kind + "s are called '" + items[i].name + "'",
                         "the other one is at " + items[j].origin.text(), "give one of them another name");
      }
    }
  }
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
  validate_names(geometry.fractures, "fracture");
  validate_names(geometry.regions, "region");
  for (std::size_t i = 0; i < geometry.fractures.size(); ++i) {
    const FractureGeometry& fracture = geometry.fractures[i];
    validate_size("size", fracture.size, fracture.origin);
    validate_fracture(geometry.box, fracture);
    for (std::size_t j = 0; j < i; ++j) validate_pair(geometry.box, geometry.fractures[j], fracture);
  }
  for (const RegionGeometry& region : geometry.regions) validate_region(geometry.box, region);
  validate_cell_count(geometry, options);
}

}  // namespace sprekk
