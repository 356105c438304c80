#include "framework/mesh/gmsh_cavity.hpp"

#include <gmsh.h>

#include <algorithm>
#include <vector>

#include "framework/mesh/gmsh_drawing.hpp"
#include "framework/mesh/gmsh_model.hpp"
#include "framework/mesh/planar.hpp"

namespace sprekk {
namespace {

using Place = CavityOutline::Edge::Place;

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

void describe(const CavityOutline& outline, const CanonicalDrawing& drawing) {
  enter_drawing(drawing);
  std::vector<int> inner;
  for (std::size_t e = 0; e < outline.edges.size(); ++e) {
    gmsh::model::geo::mesh::setTransfiniteCurve(drawing.line_number[e] + 1, 2);
    if (outline.edges[e].place == Place::inside) inner.push_back(static_cast<int>(e));
  }
  add_surface(drawing, rim_loops(outline), inner);
}

void fetch(const CavityOutline& outline, Triangulation& filling) {
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
    filling.points.emplace_back(coordinates[3 * i], coordinates[3 * i + 1]);
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

}  // namespace

Triangulation fill_with_gmsh(const CavityOutline& given, const CanonicalDrawing& drawing, const CavityOutline& drawn,
                             const std::function<double(const Point&)>& size) {
  Triangulation filling;
  const GmshModel model;
  model.run("fill the cavity", [&] {
    constexpr int delaunay = 5;
    gmsh::option::setNumber("Mesh.Algorithm", delaunay);
    describe(given, drawing);
    gmsh::model::mesh::setSizeCallback([&](int, int, double x, double y, double) { return size({x, y}); });
    gmsh::model::mesh::generate(2);
    fetch(drawn, filling);
  });
  return filling;
}

}  // namespace sprekk
