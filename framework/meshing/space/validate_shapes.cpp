#include "framework/meshing/validate_shapes.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "framework/mesh/geometry.hpp"
#include "framework/mesh/medium.hpp"
#include "framework/meshing/space/flat_shape.hpp"
#include "framework/meshing/space/region_borders.hpp"
#include "framework/meshing/space/rim_gaps.hpp"
#include "framework/meshing/space/sizes_in_space.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

/// Of the extent of a polygon: its corners may be so far from its plane, into which they are moved. OpenCASCADE takes
/// lines nearer than 1e-7 for one.
constexpr double flat = 1e-7;

std::string quoted_name(const FractureGeometry& fracture) { return "fracture '" + fracture.name + "'"; }

void validate_ellipse(const Box& box, const FractureGeometry& fracture, double snap) {
  const auto& [center, one, other] = *fracture.ellipse;
  const std::string what = quoted_name(fracture);
  if (!center.allFinite() || !(std::min(one.norm(), other.norm()) > point_tolerance(box)) || !one.allFinite() ||
      !other.allFinite())
    throw InputError(fracture.origin, what + " has no area", "its centre is " + to_text(center),
                     "write center: [x, y, z] and a radius");
  for (int axis = 0; axis < dimension; ++axis) {
    Point reach = Point::Zero();
    reach[axis] = std::hypot(one[axis], other[axis]);
    const double over = std::max(box.low[axis] - center[axis], center[axis] - box.high[axis]) + reach[axis];
    if (over < -std::max(snap, rounding::far_above * box.size().norm())) continue;
    const bool is_low = center[axis] - box.low[axis] < box.high[axis] - center[axis];
    throw InputError(fracture.origin,
                     what + (over > 0                       ? " leaves the box"
                             : over < -point_tolerance(box) ? " nearly touches the boundary with its rim"
                                                            : " touches the boundary with its rim"),
                     fmt::format("at {} it is {:.3g} m {}", to_text(center + (is_low ? -1 : 1) * reach), std::abs(over),
                                 over > 0 ? "outside" : "inside"),
                     "move it, choose another radius, or give it as a polygon that ends on the side");
  }
}

/// Throws InputError where edges of a polygon that are not neighbours meet, or neighbours fold back.
void validate_simple(const FractureGeometry& fracture, double tolerance) {
  const std::vector<Line> edges = edges_of(fracture.points);
  const std::size_t n = edges.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) {
      const bool is_next = j == i + 1, wraps = i == 0 && j == n - 1;
      const Line &first = wraps ? edges[j] : edges[i], &second = wraps ? edges[i] : edges[j];
      const auto [one, other] = nearest_points(edges[i], edges[j]);
      const bool meet = is_next || wraps ? (nearest_point(second.to, first) - second.to).norm() < tolerance ||
                                               (nearest_point(first.from, second) - first.from).norm() < tolerance
                                         : (one - other).norm() < tolerance;
      if (meet)
        throw InputError(fracture.origin, quoted_name(fracture) + " meets itself",
                         fmt::format("its edges {} and {} meet near {}", i + 1, j + 1,
                                     to_text(is_next || wraps ? second.from : one)),
                         "give its corners in the order in which they go around it");
    }
}

void validate_polygon(const Box& box, const FractureGeometry& fracture, double snap) {
  const double tolerance = point_tolerance(box);
  const std::string what = quoted_name(fracture);
  const auto& points = fracture.points;
  if (points.size() < 3)
    throw InputError(fracture.origin, what + " has fewer than three points", "it is a flat polygon",
                     "write points: [[x, y, z], [x, y, z], [x, y, z]]");
  for (const Point& point : points)
    if (point.allFinite() && depth(box, point) < -tolerance)
      throw InputError(fracture.origin, what + " leaves the box",
                       fmt::format("its point {} lies {:.3g} m outside", to_text(point),
                                   (point - point.cwiseMax(box.low).cwiseMin(box.high)).norm()),
                       "move the point or enlarge the box");
  validate_points(box, points, what, fracture.origin);
  const double extent = extent_of(fracture);
  for (std::size_t i = 0; i < points.size(); ++i)
    if ((points[i] - points[(i + 1) % points.size()]).norm() < tolerance)
      throw InputError(fracture.origin, what + " has the same point twice in a row", "at " + to_text(points[i]),
                       "the polygon closes itself; leave one of the points out");
  validate_simple(fracture, tolerance);
  const FlatShape shape(points);
  if (shape.area() < tolerance * extent)
    throw InputError(fracture.origin, what + " has no area", "its points lie on a line from " + to_text(points[0]),
                     "move one of them");
  const double off = shape.farthest_from_plane();
  if (off > flat * extent)
    throw InputError(
        fracture.origin, what + " is not flat",
        fmt::format("a point is {:.3g} m off the plane through its points", off),
        fmt::format("give points with more digits (up to {:.1g} m is flat), cut it into triangles, or give "
                    "center, strike and dip",
                    flat * extent));
  for (int axis = 0; axis < dimension; ++axis)
    for (const double side : {box.low[axis], box.high[axis]})
      if (std::ranges::all_of(points, [&](const Point& x) { return std::abs(x[axis] - side) < tolerance; }))
        throw InputError(fracture.origin, what + " runs along the boundary", "at " + to_text(points[0]),
                         "move it into the " + medium_name());
  const double reach = std::max(snap, rounding::far_above * box.size().norm());
  for (const Point& point : points)
    if (const double gap = depth(box, point); gap > tolerance && gap < reach)
      throw InputError(fracture.origin, what + " nearly touches the boundary",
                       fmt::format("its point {} is {:.3g} m away from it", to_text(point), gap),
                       "let it end on the boundary, or farther away from it");
}

/// An inner point of a simple polygon: the middle of the inner ones of the triangles between three neighbours.
FlatPoint inner_point(const FlatShape& shape) {
  const auto& outline = shape.outline();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const FlatPoint middle = (outline[i] + outline[(i + 1) % outline.size()] + outline[(i + 2) % outline.size()]) / 3;
    if (shape.contains(middle, 0)) return middle;
  }
  return outline[0];
}

/// A place that two polygons in one plane both cover, if there is one.
const Point* common_place(const FlatShape& one, const FlatShape& other, double tolerance, Point& at) {
  const auto covers = [&](const FlatShape& shape, const Point& x) {
    return shape.contains(shape.in_plane(x), tolerance);
  };
  for (const auto& [a, b] : {std::pair(&one, &other), std::pair(&other, &one)}) {
    at = a->in_space(inner_point(*a));
    if (covers(*b, at)) return &at;
    for (const auto& [from, to] : edges_of(a->corners()))
      for (const double share : {0.0, 0.5}) {
        at = from + share * (to - from);
        if (covers(*b, at)) return &at;
      }
  }
  for (const Line& edge : edges_of(one.corners()))
    for (const Line& across : edges_of(other.corners())) {
      const auto [a, b] = nearest_points(edge, across);
      const auto is_end = [&](const Point& x) {
        return std::min({(x - edge.from).norm(), (x - edge.to).norm(), (x - across.from).norm(),
                         (x - across.to).norm()}) < tolerance;
      };
      const Point u = (edge.to - edge.from).normalized(), v = (across.to - across.from).normalized();
      at = a;
      if ((a - b).norm() < tolerance && !is_end(a) && u.cross(v).norm() > rounding::far_above) return &at;
    }
  return nullptr;
}

/// Throws InputError if two fractures overlap, or nearly touch.
void validate_pair(const FractureGeometry& a, const FractureGeometry& b, const FlatShape& one, const FlatShape& other,
                   double tolerance, double reach) {
  const auto refuse = [&](const std::string& how, const std::string& why, const std::string& hint) {
    throw InputError(b.origin, "fracture '" + b.name + "' " + how + " fracture '" + a.name + "'",
                     why + "; '" + a.name + "' is at " + a.origin.text(), hint);
  };
  const auto refuse_gap = [&](const Point& at, double gap) {
    refuse("nearly touches", fmt::format("at {} they are {:.3g} m apart", to_text(at), gap),
           "let them touch there, or keep apart by more");
  };
  const auto lies_in = [&](const FlatShape& shape, const FlatShape& plane) {
    return std::ranges::all_of(shape.corners(), [&](const Point& x) { return std::abs(plane.height(x)) < tolerance; });
  };
  const auto refuse_overlap = [&](const Point& at) {
    refuse("overlaps", "they lie in one plane and both cover " + to_text(at), "end one where they meet");
  };
  if (Point at; (lies_in(one, other) || lies_in(other, one)) && common_place(one, other, tolerance, at))
    refuse_overlap(at);
  if (a.ellipse || b.ellipse) {
    const auto flat_of = [](const FractureGeometry& fracture, const FlatShape& shape) {
      return fracture.ellipse ? FlatFracture{shape, Rim(*fracture.ellipse)} : FlatFracture{shape};
    };
    const FlatFracture first = flat_of(a, one), second = flat_of(b, other);
    // Beside what the corners of the ellipse's polygon find.
    if (lies_in(one, other) || lies_in(other, one))
      if (const auto at = find_overlap(first, second, tolerance)) refuse_overlap(*at);
    if (const auto gap = find_gap(first, second, tolerance, reach)) refuse_gap(gap->at, gap->width);
    return;
  }
  for (const auto& [shape, corners] : {std::pair(&one, &other.corners()), std::pair(&other, &one.corners())})
    for (const Point& corner : *corners)
      if (const double gap = shape->distance(corner); gap > tolerance && gap < reach) refuse_gap(corner, gap);
  for (const Line& edge : edges_of(one.corners()))
    for (const Line& across : edges_of(other.corners())) {
      const auto [x, y] = nearest_points(edge, across);
      if (const double gap = (x - y).norm(); gap > tolerance && gap < reach) refuse_gap(x, gap);
    }
}

}  // namespace

void validate_fracture(const Box& box, const FractureGeometry& fracture, double snap) {
  if (fracture.ellipse)
    validate_ellipse(box, fracture, snap);
  else
    validate_polygon(box, fracture, snap);
}

void validate_pairs(const Geometry& geometry, Problems& problems) {
  const double tolerance = point_tolerance(geometry.box);
  const double reach = std::max(geometry.snap.value_or(0), rounding::far_above * geometry.box.size().norm());
  std::vector<const FractureGeometry*> sound;
  std::vector<FlatShape> shapes;
  for (const FractureGeometry& fracture : geometry.fractures) {
    Problems own;
    collect(own, [&] { validate_fracture(geometry.box, fracture, geometry.snap.value_or(0)); });
    if (!own.empty()) continue;
    sound.push_back(&fracture);
    shapes.emplace_back(fracture);
  }
  for (std::size_t j = 0; j < sound.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      const Point apart = (shapes[i].low() - shapes[j].high()).cwiseMax(shapes[j].low() - shapes[i].high());
      if (apart.maxCoeff() > reach) continue;
      collect(problems, [&] { validate_pair(*sound[i], *sound[j], shapes[i], shapes[j], tolerance, reach); });
    }
}

void validate_region(const Box& box, const RegionGeometry& region) {
  const std::string what = "region '" + region.name + "'";
  if (region.name == medium_name())
    throw InputError(region.origin, "a region is called '" + region.name + "'",
                     "that is the name of everything outside of all regions", "choose another name");
  for (const HalfSpace& half : region.half_spaces)
    if (!half.point.allFinite() || !half.normal.allFinite() || !(half.normal.norm() > 0))
      throw InputError(region.origin, what + " has a plane without a direction",
                       "its normal is " + to_text(half.normal) + " at " + to_text(half.point),
                       "write normal: [0, 0, 1]");
  (void)box;
}

double wanted_cells(const Geometry& geometry, const MeshOptions& options) {
  return SizesInSpace(geometry, options).estimated_cells();
}

}  // namespace sprekk
