#include "components/fine_fracture/fine_level/geometry.hpp"

#include <algorithm>
#include <stdexcept>

#include "components/fine_fracture/fine_level/outline.hpp"
#include "framework/mesh/plane/planar.hpp"

namespace sprekk::fine_fracture {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument("fine level: " + what); }

void validate_outline(const FineGeometry& geometry) {
  const auto& outline = geometry.outline;
  const std::size_t n = outline.size();
  if (n < 3) refuse("the outline has less than three points");
  for (std::size_t i = 0; i < n; ++i) {
    if (!(signed_area(outline[i], outline[(i + 1) % n], outline[(i + 2) % n]) > 0)) {
      refuse("the outline is not convex and counter-clockwise at " + to_text(outline[(i + 1) % n]));
    }
  }
  if (!geometry.sides.empty() && geometry.sides.size() != n) refuse("the outline needs one kind per edge");
}

bool is_tip(const CrackPath& crack, std::size_t point) {
  return (point == 0 && crack.first_is_tip) || (point + 1 == crack.points.size() && crack.last_is_tip);
}

void validate_crack(const FineGeometry& geometry, const std::vector<CrackJunction>& junctions, int index,
                    double tolerance) {
  const CrackPath& crack = geometry.cracks[index];
  const std::size_t n = crack.points.size();
  if (n < 2) refuse("a crack has less than two points");
  if (crack.walls.size() + 1 != n) refuse("a crack needs one kind of walls per segment");
  std::vector<char> is_junction(n, false);
  for (const CrackJunction& junction : junctions)
    for (const auto& [c, point] : junction.vertices)
      if (c == index) is_junction[point] = true;
  for (std::size_t i = 0; i < n; ++i) {
    if (is_junction[i] && is_tip(crack, i)) refuse("a tip lies at another crack in " + to_text(crack.points[i]));
    const bool may_touch = (i == 0 || i + 1 == n) && !is_tip(crack, i) && !is_junction[i];
    const double depth = depth_inside(crack.points[i], geometry.outline);
    if (may_touch ? std::abs(depth) > tolerance : depth <= tolerance) {
      refuse("the crack's point " + to_text(crack.points[i]) +
             (may_touch ? " is an end without a tip and lies neither on the outline nor at another crack"
                        : " does not lie inside the outline"));
    }
    if (i > 0 && (crack.points[i] - crack.points[i - 1]).norm() <= tolerance) {
      refuse("the crack repeats the point " + to_text(crack.points[i]));
    }
  }
}

/// Whether two segments with a common end have different directions there, and no other common point.
bool part_from_shared_end(const Segment& a, const Segment& b, double tolerance) {
  for (const auto& [shared, end] : {std::pair(a.from, a.to), std::pair(a.to, a.from)})
    for (const auto& [also_shared, other] : {std::pair(b.from, b.to), std::pair(b.to, b.from)})
      if ((shared - also_shared).norm() <= tolerance)
        return distance(end, b) > tolerance && distance(other, a) > tolerance;
  return false;
}

}  // namespace

std::vector<CrackJunction> junctions(const FineGeometry& geometry) {
  const double tolerance = outline_tolerance(geometry.outline);
  std::vector<CrackJunction> places;
  for (int c = 0; c < static_cast<int>(geometry.cracks.size()); ++c) {
    const auto& points = geometry.cracks[c].points;
    for (int i = 0; i < static_cast<int>(points.size()); ++i) {
      const auto same = std::find_if(places.begin(), places.end(), [&](const CrackJunction& place) {
        return (place.position - points[i]).norm() <= tolerance;
      });
      if (same != places.end())
        same->vertices.push_back({c, i});
      else
        places.push_back({points[i], {{c, i}}});
    }
  }
  std::erase_if(places,
                [](const CrackJunction& place) { return place.vertices.front().crack == place.vertices.back().crack; });
  return places;
}

void validate(const FineGeometry& geometry) {
  validate_outline(geometry);
  const double tolerance = outline_tolerance(geometry.outline);
  const std::vector<CrackJunction> shared = junctions(geometry);
  for (std::size_t c = 0; c < geometry.cracks.size(); ++c)
    validate_crack(geometry, shared, static_cast<int>(c), tolerance);
  std::vector<std::pair<std::size_t, Segment>> segments;
  for (std::size_t c = 0; c < geometry.cracks.size(); ++c) {
    const auto& points = geometry.cracks[c].points;
    const std::size_t begin = segments.size();
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const Segment segment{points[i], points[i + 1]};
      // Segments that follow each other along a path share a point.
      const std::size_t others = i == 0 ? begin : segments.size() - 1;
      for (std::size_t k = 0; k < others; ++k) {
        const auto& [other_crack, other] = segments[k];
        if (distance(segment, other) > tolerance) continue;
        if (other_crack != c && part_from_shared_end(segment, other, tolerance)) continue;
        refuse("cracks meet near " + to_text(points[i]) + " other than in a point of both");
      }
      segments.push_back({c, segment});
    }
  }
}

}  // namespace sprekk::fine_fracture
