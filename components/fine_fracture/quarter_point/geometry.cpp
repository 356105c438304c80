#include "components/fine_fracture/quarter_point/geometry.hpp"

#include <stdexcept>

#include "components/fine_fracture/quarter_point/outline.hpp"
#include "framework/mesh/planar.hpp"

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

void validate_crack(const FineGeometry& geometry, const CrackPath& crack, double tolerance) {
  const std::size_t n = crack.points.size();
  if (n < 2) refuse("a crack has less than two points");
  if (crack.walls.size() + 1 != n) refuse("a crack needs one kind of walls per segment");
  for (std::size_t i = 0; i < n; ++i) {
    const bool may_touch = (i == 0 && !crack.first_is_tip) || (i + 1 == n && !crack.last_is_tip);
    const double depth = depth_inside(crack.points[i], geometry.outline);
    if (may_touch ? std::abs(depth) > tolerance : depth <= tolerance) {
      refuse("the crack's point " + to_text(crack.points[i]) +
             (may_touch ? " is an end without a tip and does not lie on the outline"
                        : " does not lie inside the outline"));
    }
    if (i > 0 && (crack.points[i] - crack.points[i - 1]).norm() <= tolerance) {
      refuse("the crack repeats the point " + to_text(crack.points[i]));
    }
  }
}

}  // namespace

void validate(const FineGeometry& geometry) {
  validate_outline(geometry);
  const double tolerance = outline_tolerance(geometry.outline);
  for (const CrackPath& crack : geometry.cracks) validate_crack(geometry, crack, tolerance);
  std::vector<std::pair<std::size_t, Segment>> segments;
  for (std::size_t c = 0; c < geometry.cracks.size(); ++c) {
    const auto& points = geometry.cracks[c].points;
    const std::size_t begin = segments.size();
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const Segment segment{points[i], points[i + 1]};
      // Neighbours along a path share a point.
      const std::size_t others = i == 0 ? begin : segments.size() - 1;
      for (std::size_t k = 0; k < others; ++k) {
        if (distance(segment, segments[k].second) <= tolerance) refuse("cracks meet near " + to_text(points[i]));
      }
      segments.push_back({c, segment});
    }
  }
}

}  // namespace sprekk::fine_fracture
