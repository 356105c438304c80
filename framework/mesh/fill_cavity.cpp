#include "framework/mesh/fill_cavity.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "framework/mesh/gmsh_model.hpp"
#include "framework/mesh/planar.hpp"

namespace sprekk {
namespace {

using Place = CavityOutline::Edge::Place;

/// gmsh works near the origin on something of size between 1 and 2, see unstructured_mesh.cpp.
struct Frame {
  Point origin;
  double scale;

  explicit Frame(const std::vector<Point>& points) {
    Point low = points.front(), high = low;
    for (const Point& x : points) low = low.cwiseMin(x), high = high.cwiseMax(x);
    origin = low;
    scale = std::exp2(std::floor(std::log2((high - low).maxCoeff())));
  }
  Point inward(const Point& x) const { return (x - origin) / scale; }
  Point outward(double x, double y) const { return origin + scale * Point(x, y); }
};

/// Edge lengths between inner edges and rim, in the frame.
class Sizes {
 public:
  Sizes(const CavityOutline& outline, const Frame& frame, double growth) : growth_(growth) {
    for (const auto& [points, place, is_barrier] : outline.edges) {
      const Segment s{frame.inward(outline.points[points[0]]), frame.inward(outline.points[points[1]])};
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
    // So steep that the rim's size is reached at the rim.
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

/// The rim's edges in closed loops, the outermost first.
std::vector<std::vector<int>> rim_loops(const CavityOutline& outline) {
  std::vector<int> leaving(outline.points.size(), -1);
  for (std::size_t e = 0; e < outline.edges.size(); ++e) {
    if (outline.edges[e].place == Place::rim) leaving[outline.edges[e].points[0]] = static_cast<int>(e);
  }
  std::vector<bool> is_done(outline.edges.size());
  std::vector<std::vector<int>> loops;
  std::vector<double> areas;
  for (std::size_t e = 0; e < outline.edges.size(); ++e) {
    if (outline.edges[e].place != Place::rim || is_done[e]) continue;
    std::vector<int> loop;
    std::vector<Point> polygon;
    for (int next = static_cast<int>(e); next >= 0 && !is_done[next]; next = leaving[outline.edges[next].points[1]]) {
      is_done[next] = true;
      loop.push_back(next);
      polygon.push_back(outline.points[outline.edges[next].points[0]]);
    }
    loops.push_back(std::move(loop));
    areas.push_back(signed_area(polygon));
  }
  const auto outermost = std::max_element(areas.begin(), areas.end()) - areas.begin();
  std::swap(loops.front(), loops[outermost]);
  return loops;
}

void describe(const CavityOutline& outline, const Frame& frame) {
  for (std::size_t i = 0; i < outline.points.size(); ++i) {
    const Point x = frame.inward(outline.points[i]);
    gmsh::model::geo::addPoint(x.x(), x.y(), 0, 0, static_cast<int>(i) + 1);
  }
  std::vector<int> inner;
  for (std::size_t e = 0; e < outline.edges.size(); ++e) {
    const auto& [points, place, is_barrier] = outline.edges[e];
    const int tag = static_cast<int>(e) + 1;
    gmsh::model::geo::addLine(points[0] + 1, points[1] + 1, tag);
    gmsh::model::geo::mesh::setTransfiniteCurve(tag, 2);
    if (place == Place::inside) inner.push_back(tag);
  }
  std::vector<int> loops;
  for (const auto& loop : rim_loops(outline)) {
    std::vector<int> tags;
    for (const int edge : loop) tags.push_back(edge + 1);
    loops.push_back(gmsh::model::geo::addCurveLoop(tags));
  }
  const int surface = gmsh::model::geo::addPlaneSurface(loops);
  gmsh::model::geo::synchronize();
  if (!inner.empty()) gmsh::model::mesh::embed(1, inner, 2, surface);
}

void fetch(const CavityOutline& outline, const Frame& frame, Triangulation& filling) {
  std::vector<std::size_t> tags, elements;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters, -1, -1, false, false);
  std::vector<int> number(tags.empty() ? 0 : *std::max_element(tags.begin(), tags.end()) + 1, -1);
  filling.points = outline.points;
  for (std::size_t i = 0; i < outline.points.size(); ++i) {
    std::vector<std::size_t> node;
    std::vector<double> place, parameter;
    gmsh::model::mesh::getNodes(node, place, parameter, 0, static_cast<int>(i) + 1, false, false);
    number[node.at(0)] = static_cast<int>(i);
  }
  for (std::size_t i = 0; i < tags.size(); ++i) {
    if (number[tags[i]] >= 0) continue;
    number[tags[i]] = static_cast<int>(filling.points.size());
    filling.points.push_back(frame.outward(coordinates[3 * i], coordinates[3 * i + 1]));
  }
  tags.clear();
  constexpr int three_node_triangle = 2;
  gmsh::model::mesh::getElementsByType(three_node_triangle, elements, tags);
  for (std::size_t i = 0; i + 2 < tags.size(); i += 3) {
    std::array<int, 3> t{number[tags[i]], number[tags[i + 1]], number[tags[i + 2]]};
    if (signed_area(filling.points[t[0]], filling.points[t[1]], filling.points[t[2]]) < 0) std::swap(t[1], t[2]);
    filling.triangles.push_back(t);
  }
}

/// Whether each edge is there, and the triangles cover what is inside of the rim.
void verify(const CavityOutline& outline, const Triangulation& filling) {
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
                               to_text(0.5 * (outline.points[points[0]] + outline.points[points[1]])));
    }
    if (place == Place::rim) {
      const Point& origin = outline.points.front();
      wanted += 0.5 * cross(outline.points[points[0]] - origin, outline.points[points[1]] - origin);
    }
  }
  if (!(std::abs(area - wanted) < 1e-9 * wanted) || smallest_angle(filling) <= 0) {
    throw std::runtime_error("the mesh generator left a part of the cavity empty near " +
                             to_text(outline.points.front()));
  }
}

}  // namespace

Triangulation fill_cavity(const CavityOutline& outline, double growth, MeshMethod method) {
  Triangulation filling;
  {
    const GmshModel model;
    model.run("fill the cavity", [&] {
      // GmshModel chooses the frontal one.
      if (method == MeshMethod::delaunay) gmsh::option::setNumber("Mesh.Algorithm", 5);
      const Frame frame(outline.points);
      const Sizes sizes(outline, frame, growth);
      describe(outline, frame);
      gmsh::model::mesh::setSizeCallback([&](int, int, double x, double y, double) { return sizes.at({x, y}); });
      gmsh::model::mesh::generate(2);
      fetch(outline, frame, filling);
    });
  }
  verify(outline, filling);
  filling.is_fixed.assign(filling.points.size(), false);
  std::fill_n(filling.is_fixed.begin(), outline.points.size(), true);
  for (const auto& [points, place, is_barrier] : outline.edges) filling.fixed_edges.push_back({points, is_barrier});
  improve(filling);
  return filling;
}

}  // namespace sprekk
