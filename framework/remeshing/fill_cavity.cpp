#include "framework/remeshing/fill_cavity.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "framework/mesh/plane/planar.hpp"
#include "framework/round_off.hpp"
#include "framework/triangulation/canonical_drawing.hpp"
#include "framework/triangulation/mesh_region.hpp"

namespace sprekk {
namespace {

using Place = CavityOutline::Edge::Place;

/// The wanted edge lengths between the inner edges and the rim.
class Sizes {
 public:
  Sizes(const CavityOutline& outline, double growth) : growth_(growth) {
    for (const auto& [points, place, is_barrier] : outline.edges) {
      const Segment s{outline.points[points[0]], outline.points[points[1]]};
      sources_[place == Place::rim].push_back({s, s.length()});
    }
  }

  double at(const Point& x) const {
    double upper = std::numeric_limits<double>::infinity(), nearest[2] = {upper, upper}, size[2] = {0, 0};
    for (const int side : {0, 1}) {
      for (const auto& [segment, length] : sources_[side]) {
        const double d = distance(x, segment);
        upper = std::min(upper, length + growth_ * d);
        if (d < nearest[side]) nearest[side] = d, size[side] = length;
      }
    }
    if (sources_[0].empty()) return upper;
    const double sum = nearest[0] + nearest[1];
    // At least linear between the two nearest edges, so that sizes reach the length of the rim's edges at the rim
    // (mesh_region() follows slopes up to a half).
    const double straight = sum > 0 ? (size[0] * nearest[1] + size[1] * nearest[0]) / sum : 0;
    return std::max(upper, straight);
  }

 private:
  struct Source {
    Segment segment;
    double length;
  };
  std::vector<Source> sources_[2];  ///< inside, rim
  double growth_;
};

/// The outline in the frame of the drawing, with its points and edges in the order of the drawing. Edges of the rim
/// keep their direction.
CavityOutline canonical(const CavityOutline& outline, const CanonicalDrawing& drawing) {
  CavityOutline result{drawing.points, std::vector<CavityOutline::Edge>(outline.edges.size())};
  for (std::size_t e = 0; e < outline.edges.size(); ++e) {
    CavityOutline::Edge edge = outline.edges[e];
    const int number = drawing.line_number[e];
    edge.points = drawing.lines[number];
    if (edge.place == Place::rim && drawing.is_reversed[e]) std::swap(edge.points[0], edge.points[1]);
    result.edges[number] = edge;
  }
  return result;
}

Triangulation triangulate(const CavityOutline& outline, const std::function<double(const Point&)>& size) {
  RegionDrawing drawing{outline.points, {}};
  for (const auto& [points, place, is_barrier] : outline.edges)
    drawing.lines.push_back({points, place == Place::rim, true});
  const RegionMesh mesh = mesh_region(drawing, size);
  Triangulation filling;
  filling.points = mesh.points;
  for (const Ring& triangle : mesh.triangles) filling.triangles.push_back({triangle[0], triangle[1], triangle[2]});
  return filling;
}

/// Checks that each edge of the outline is an edge of the filling, and that the triangles cover the inside of the rim.
void verify(const CavityOutline& outline, const CanonicalDrawing& drawing, const Triangulation& filling) {
  std::vector<std::array<int, 2>> edges;
  double area = 0, wanted = 0;
  for (const auto& t : filling.triangles) {
    for (int k = 0; k < 3; ++k) edges.push_back({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
    area += signed_area(filling.points[t[0]], filling.points[t[1]], filling.points[t[2]]);
  }
  std::sort(edges.begin(), edges.end());
  for (const auto& [points, place, is_barrier] : outline.edges) {
    const std::array<int, 2> edge{std::min(points[0], points[1]), std::max(points[0], points[1])};
    if (!std::binary_search(edges.begin(), edges.end(), edge)) {
      throw std::runtime_error("the mesh generator lost the edge at " +
                               to_text(drawing.outward(0.5 * (outline.points[points[0]] + outline.points[points[1]]))));
    }
    if (place == Place::rim) {
      const Point& origin = outline.points.front();
      wanted += 0.5 * cross(outline.points[points[0]] - origin, outline.points[points[1]] - origin);
    }
  }
  if (!(std::abs(area - wanted) < rounding::same * wanted) || smallest_angle(filling) <= 0) {
    throw std::runtime_error("the mesh generator left a part of the cavity empty near " +
                             to_text(drawing.outward(outline.points.front())));
  }
}

/// Transforms the filling from the frame and numbers of the drawing back to those of the outline.
void take_back(const CavityOutline& outline, const CanonicalDrawing& drawing, Triangulation& filling) {
  std::vector<int> number(filling.points.size());
  std::iota(number.begin(), number.end(), 0);
  for (std::size_t i = 0; i < outline.points.size(); ++i) number[drawing.point_number[i]] = static_cast<int>(i);
  for (auto& triangle : filling.triangles)
    for (int& point : triangle) point = number[point];
  for (auto& edge : filling.fixed_edges)
    for (int& point : edge.points) point = number[point];
  for (std::size_t i = outline.points.size(); i < filling.points.size(); ++i)
    filling.points[i] = drawing.outward(filling.points[i]);
  std::copy(outline.points.begin(), outline.points.end(), filling.points.begin());
}

}  // namespace

std::vector<std::array<int, 2>> lines_of(const CavityOutline& outline) {
  std::vector<std::array<int, 2>> lines;
  for (const CavityOutline::Edge& edge : outline.edges) lines.push_back(edge.points);
  return lines;
}

Triangulation fill_cavity(const CavityOutline& given, double size_factor, double growth) {
  const CanonicalDrawing drawing(given.points, lines_of(given));
  const CavityOutline outline = canonical(given, drawing);
  const Sizes sizes(outline, growth);
  Triangulation filling = triangulate(outline, [&](const Point& x) { return size_factor * sizes.at(x); });
  verify(outline, drawing, filling);
  filling.is_fixed.assign(filling.points.size(), false);
  std::fill_n(filling.is_fixed.begin(), outline.points.size(), true);
  for (const auto& [points, place, is_barrier] : outline.edges) filling.fixed_edges.push_back({points, is_barrier});
  improve(filling);
  take_back(given, drawing, filling);
  return filling;
}

}  // namespace sprekk
