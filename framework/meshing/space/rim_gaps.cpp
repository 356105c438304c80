#include "framework/meshing/space/rim_gaps.hpp"

#include <algorithm>
#include <limits>

namespace sprekk {
namespace {

double distance(const Point& x, const FlatFracture& to) {
  return to.rim ? to.rim->distance_to_disc(x) : to.polygon.distance(x);
}

/// How far a place in the plane of a fracture is outside of it; negative inside.
double outside(const FlatFracture& of, const Point& x) {
  if (of.rim) return of.rim->outside(x);
  double to_edges = std::numeric_limits<double>::infinity();
  for (const Line& edge : edges_of(of.polygon.corners()))
    to_edges = std::min(to_edges, (nearest_point(x, edge) - x).norm());
  return of.polygon.contains(of.polygon.in_plane(x), 0) ? -to_edges : to_edges;
}

}  // namespace

std::optional<RimGap> find_gap(const FlatFracture& one, const FlatFracture& other, double tolerance, double reach) {
  std::optional<RimGap> found;
  const auto consider = [&](const Point& at, double width) {
    if (!found && width > tolerance && width < reach) found = RimGap{at, width};
  };
  for (const auto& [a, b] : {std::pair(&one, &other), std::pair(&other, &one)}) {
    const auto to_inside = [to = b](const Point& x) { return distance(x, *to); };
    if (!a->rim) {
      for (const Point& corner : a->polygon.corners()) consider(corner, to_inside(corner));
      continue;
    }
    a->rim->for_each_minimum(reach, to_inside, consider);
    // Where it passes the plane by little, the rim is near on the other side.
    for (const Point& x : a->rim->farthest_from(b->polygon.normal())) consider(x, to_inside(x));
    if (b->rim) {
      a->rim->for_each_minimum(
          reach, [to = b](const Point& x) { return to->rim->distance(x); }, consider);
      continue;
    }
    for (const Line& edge : edges_of(b->polygon.corners()))
      a->rim->for_each_minimum(
          reach, [&](const Point& x) { return (nearest_point(x, edge) - x).norm(); }, consider);
  }
  return found;
}

std::optional<Point> find_overlap(const FlatFracture& one, const FlatFracture& other, double tolerance) {
  std::optional<Point> found;
  for (const auto& [a, b] : {std::pair(&one, &other), std::pair(&other, &one)}) {
    const auto outside_other = [of = b](const Point& x) { return outside(*of, x); };
    const auto consider = [&](const Point& at, double by) {
      if (by < -tolerance) found = at;
    };
    if (a->rim)
      a->rim->for_each_minimum(0, outside_other, consider);
    else
      for (const Point& corner : a->polygon.corners()) consider(corner, outside_other(corner));
  }
  return found;
}

}  // namespace sprekk
