#include "components/fine_fracture/quarter_point/elasticity/cut_elements.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "components/fine_fracture/quarter_point/elasticity/shapes.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/mesh.hpp"
#include "framework/mesh/plane/planar.hpp"

namespace sprekk::fine_fracture {
namespace {

/// Of the rule for stiffness and stress offset where stiffnesses differ and no border tells where; both have to be
/// taken at the same places.
constexpr int degree_of_cut = 6;

using Corners = std::array<Point, 3>;  ///< of a triangle

/// Whether the rule of many points finds two stiffnesses in the element.
bool differs(const FineMesh& mesh, const FineMesh::Element& element, const FineRock& rock) {
  std::optional<Elasticity> first;
  for (const TrianglePoint& place : triangle_rule(degree_of_cut)) {
    const Elasticity here = rock.at(shape_point(mesh, element, place.xi, place.eta).x);
    if (first && !(here == *first)) return true;
    first = here;
  }
  return false;
}

/// Where borders meet the outline of a triangle.
struct Crossings {
  std::array<std::optional<double>, 3> edge;  ///< between the corners of each edge, from 0 at its first one to 1
  std::array<bool, 3> corner = {};            ///< at each corner
};

/// The crossings, or nothing where an edge has two of them. A border through a node of the mesh, as where it begins at
/// a fracture, meets the corners of elements there except for round-off: these are no crossings of edges.
std::optional<Crossings> crossings_of(const Corners& corners, const std::vector<FineRock::Border>& borders) {
  const Point low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]);
  const Point high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]);
  // Of a border, and of the sine of an angle: round-off where pieces of a border meet.
  constexpr double rounding = 1e-12;
  constexpr double same = 1e-9;  // of an edge
  const Point margin = Point::Constant(same * (high - low).maxCoeff());
  Crossings crossings;
  for (const FineRock::Border& border : borders) {
    const Point from = border[0].cwiseMin(border[1]), to = border[0].cwiseMax(border[1]);
    if ((from.array() > (high + margin).array()).any() || (to.array() < (low - margin).array()).any()) continue;
    for (int edge = 0; edge < 3; ++edge) {
      const int next = (edge + 1) % 3;
      const Point& start = corners[edge];
      const Point along = corners[next] - start, across = border[1] - border[0], way = border[0] - start;
      const double determinant = cross(along, across);
      if (std::abs(determinant) <= rounding * along.norm() * across.norm()) continue;
      const double on_edge = cross(way, across) / determinant, on_border = cross(way, along) / determinant;
      const double past_end = std::max(rounding, same * along.norm() / across.norm());
      if (!(on_edge >= -same && on_edge <= 1 + same && on_border >= -past_end && on_border <= 1 + past_end)) continue;
      if (on_edge <= same || on_edge >= 1 - same) {
        crossings.corner[on_edge < 0.5 ? edge : next] = true;
        continue;
      }
      // Where one border ends another one begins.
      std::optional<double>& crossing = crossings.edge[edge];
      if (crossing && std::abs(*crossing - on_edge) > same) return std::nullopt;
      crossing = on_edge;
    }
  }
  return crossings;
}

void add_triangle(const Corners& corners, int degree, std::vector<TrianglePoint>& rule) {
  const Point first = corners[1] - corners[0], second = corners[2] - corners[0];
  const double share = std::abs(cross(first, second));
  if (share == 0) return;
  for (const TrianglePoint& place : triangle_rule(degree)) {
    const Point x = corners[0] + place.xi * first + place.eta * second;
    rule.push_back({x.x(), x.y(), share * place.weight});
  }
}

Corners unit_triangle() { return {Point(0, 0), Point(1, 0), Point(0, 1)}; }

/// The rule in the triangle and the quadrangle that are left of an element with crossings of two edges.
void cut_edges(const Crossings& crossings, int degree, std::vector<TrianglePoint>& rule) {
  const Corners unit = unit_triangle();
  const auto at = [&](int edge) {
    return Point(unit[edge] + *crossings.edge[edge] * (unit[(edge + 1) % 3] - unit[edge]));
  };
  int whole = 0;  // the edge that is not crossed
  while (crossings.edge[whole]) ++whole;
  const int next = (whole + 1) % 3, last = (whole + 2) % 3;
  const Point& alone = unit[last];
  const Point behind = at(next), ahead = at(last);  // on the edges that end and begin at this corner
  add_triangle({alone, ahead, behind}, degree, rule);
  add_triangle({ahead, unit[whole], unit[next]}, degree, rule);
  add_triangle({ahead, unit[next], behind}, degree, rule);
}

/// The rule in the two triangles that are left of an element with a crossing of this edge and the opposite corner.
void cut_corner(const Crossings& crossings, int edge, int degree, std::vector<TrianglePoint>& rule) {
  const Corners unit = unit_triangle();
  const int next = (edge + 1) % 3, opposite = (edge + 2) % 3;
  const Point crossing = unit[edge] + *crossings.edge[edge] * (unit[next] - unit[edge]);
  add_triangle({unit[opposite], unit[edge], crossing}, degree, rule);
  add_triangle({unit[opposite], crossing, unit[next]}, degree, rule);
}

/// nullptr where no border cuts the triangle in two.
const std::vector<TrianglePoint>* rule_of_both_sides(const Corners& corners, const FineRock& rock, int degree) {
  const auto crossings = crossings_of(corners, rock.borders());
  if (!crossings) return nullptr;
  const auto count = std::ranges::count_if(crossings->edge, [](const auto& at) { return at.has_value(); });
  static thread_local std::vector<TrianglePoint> rule;
  rule.clear();
  if (count == 2) cut_edges(*crossings, degree, rule);
  if (count == 1)
    for (int edge = 0; edge < 3; ++edge)
      if (crossings->edge[edge] && crossings->corner[(edge + 2) % 3]) cut_corner(*crossings, edge, degree, rule);
  return rule.empty() ? nullptr : &rule;
}

Corners corners_of(const FineMesh& mesh, const FineMesh::Element& element) {
  return {mesh.nodes[element.nodes[0]], mesh.nodes[element.nodes[1]], mesh.nodes[element.nodes[2]]};
}

}  // namespace

const std::vector<TrianglePoint>& element_rule(const FineMesh& mesh, const FineMesh::Element& element,
                                               const FineRock& rock, int degree) {
  SPREKK_EXPECT(element.tip == none);
  if (rock.is_uniform()) return triangle_rule(degree);
  if (const auto* rule = rule_of_both_sides(corners_of(mesh, element), rock, degree)) return *rule;
  return triangle_rule(differs(mesh, element, rock) ? std::max(degree, degree_of_cut) : degree);
}

Elasticity rosette_stiffness(const FineMesh& mesh, const FineMesh::Element& element, const FineRock& rock) {
  SPREKK_EXPECT(element.tip != none);
  const Corners corners = corners_of(mesh, element);
  const auto at = [&](const TrianglePoint& place) {
    return rock.at(corners[0] + place.xi * (corners[1] - corners[0]) + place.eta * (corners[2] - corners[0]));
  };
  const auto* rule = rock.is_uniform() ? nullptr : rule_of_both_sides(corners, rock, 2);
  if (!rule) return at({1.0 / 3, 1.0 / 3, 0});
  Elasticity mean{0, 0};
  for (const TrianglePoint& place : *rule) {
    const Elasticity here = at(place);
    mean.lambda += 2 * place.weight * here.lambda;
    mean.shear += 2 * place.weight * here.shear;
  }
  return mean;
}

}  // namespace sprekk::fine_fracture
