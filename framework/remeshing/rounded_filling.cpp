#include "framework/remeshing/rounded_filling.hpp"

#include <algorithm>
#include <limits>
#include <set>
#include <stdexcept>

#include "framework/remeshing/spread_motion.hpp"
#include "framework/triangulation/rounded_drawing.hpp"

namespace sprekk {
namespace {

constexpr double kept_angle_part = 2.0 / 3;  ///< of the smallest angle, that moving must leave

DrawingFrame frame_of(const CavityOutline& outline, const Point& anchor) {
  Point low = outline.points.front(), high = low;
  for (const Point& x : outline.points) low = low.cwiseMin(x), high = high.cwiseMax(x);
  std::vector<Segment> lines;
  for (const auto& [a, b] : lines_of(outline)) lines.push_back({outline.points[a], outline.points[b]});
  return drawing_frame((high - low).maxCoeff(), lines, anchor);
}

/// The edge of the outline that is nearest to a point on one of them.
const CavityOutline::Edge& nearest_edge(const CavityOutline& outline, const Point& x) {
  const auto away = [&](const CavityOutline::Edge& edge) {
    return distance(x, Segment{outline.points[edge.points[0]], outline.points[edge.points[1]]});
  };
  return *std::ranges::min_element(outline.edges, {}, away);
}

/// Moves the filling of one outline to another one with the same topology. Points on edges keep their part of these.
void move(const CavityOutline& from, const CavityOutline& to, Triangulation& filling) {
  std::vector<MovedNode> moved;
  const int count = static_cast<int>(from.points.size()), all = static_cast<int>(filling.points.size());
  for (int i = 0; i < count; ++i) moved.push_back({i, to.points[i] - from.points[i]});
  for (int i = count; i < all; ++i) {
    if (!filling.is_fixed[i]) continue;
    const auto [a, b] = nearest_edge(from, filling.points[i]).points;
    const Point along = from.points[b] - from.points[a];
    const double part = (filling.points[i] - from.points[a]).dot(along) / along.squaredNorm();
    moved.push_back({i, (1 - part) * moved[a].by + part * moved[b].by});
  }
  std::set<std::array<int, 2>> edges;
  for (const auto& t : filling.triangles)
    for (int k = 0; k < 3; ++k) edges.insert({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
  const std::vector<Point> motion =
      spread_motion(filling.points, {edges.begin(), edges.end()}, std::vector<bool>(all), moved);
  for (int i = 0; i < all; ++i) filling.points[i] += motion[i];
}

}  // namespace

std::optional<Triangulation> fill_rounded_cavity(const CavityOutline& outline, double size_factor, double growth,
                                                 const Point& anchor) {
  const DrawingFrame frame = frame_of(outline, anchor);
  CavityOutline inward = outline;
  for (Point& x : inward.points) x = frame.inward(x);
  CavityOutline rounded = inward;
  rounded.points = rounded_points(inward.points, lines_of(outline), std::numeric_limits<double>::infinity());
  try {
    Triangulation filling = fill_cavity(rounded, size_factor, growth);
    const double angle = smallest_angle(filling);
    move(rounded, inward, filling);
    for (Point& x : filling.points) x = frame.outward(x);
    std::ranges::copy(outline.points, filling.points.begin());
    if (smallest_angle(filling) > kept_angle_part * angle) return filling;
  } catch (const std::runtime_error&) {
  }
  return std::nullopt;
}

}  // namespace sprekk
