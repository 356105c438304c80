// The rule for an element that a border between two stiffnesses cuts, against the areas of its parts in closed form:
// above all where the border goes through a corner, as where it begins at a fracture.
#include "components/fine_fracture/quarter_point/elasticity/cut_elements.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "components/fine_fracture/quarter_point/elasticity/shapes.hpp"
#include "framework/mesh/mesh.hpp"
#include "framework/mesh/plane/planar.hpp"

namespace sprekk::fine_fracture {
namespace {

constexpr double soft = 1, stiff = 3;  ///< the shear moduli, Pa

/// A straight triangle of about 1 mm that is 1.5 m away from the origin, with its corners in any order.
struct Triangle {
  std::array<Point, 3> corner;

  Triangle(double turn, int first) {
    const std::array<Point, 3> unit = {Point(0, 0), Point(1.1e-3, 1e-4), Point(2e-4, 0.9e-3)};
    const Point along(std::cos(turn), std::sin(turn)), aside(-along.y(), along.x());
    for (int k = 0; k < 3; ++k) {
      const Point& x = unit[(k + first) % 3];
      corner[k] = Point(1.3, 0.8) + x.x() * along + x.y() * aside;
    }
  }
  FineMesh mesh() const {
    FineMesh mesh;
    mesh.nodes.assign(corner.begin(), corner.end());
    for (int k = 0; k < 3; ++k) mesh.nodes.push_back((corner[k] + corner[(k + 1) % 3]) / 2);
    mesh.corner_count = 3;
    mesh.elements.push_back({{0, 1, 2, 3, 4, 5}, none});
    return mesh;
  }
  double area() const { return 0.5 * cross(corner[1] - corner[0], corner[2] - corner[0]); }
};

/// The integral of the shear modulus, over the area; `on_line` and `along` tell where the stiff rock begins, to the
/// left.
double mean_shear(const Triangle& triangle, const Point& on_line, const Point& along,
                  const std::vector<FineRock::Border>& borders) {
  const FineRock rock(
      [&](const Point& x) {
        return Elasticity{0, cross(along, x - on_line) > 0 ? stiff : soft};
      },
      1, borders);
  const FineMesh mesh = triangle.mesh();
  double sum = 0;
  for (const TrianglePoint& place : element_rule(mesh, mesh.elements[0], rock, 2)) {
    const ShapePoint p = shape_point(mesh, mesh.elements[0], place.xi, place.eta);
    sum += place.weight * p.jacobian * rock.at(p.x).shear;
  }
  return sum / triangle.area();
}

/// A border through corner 0 and a place on the opposite edge, which divides the area as it divides this edge. It
/// begins at the corner or behind it, ends on the edge or behind it, in one piece or two, and misses the corner by
/// round-off and more.
TEST(CutElements, ABorderThroughACornerDividesTheElement) {
  for (const double turn : {0.0, 0.4, 1.9, 3.3})
    for (int first = 0; first < 3; ++first)
      for (const double part : {0.01, 0.3, 0.5, 0.93}) {
        const Triangle triangle(turn, first);
        const Point from = triangle.corner[0],
                    to = triangle.corner[1] + part * (triangle.corner[2] - triangle.corner[1]), along = to - from;
        const double mean = part * soft + (1 - part) * stiff;
        for (const double off : {0.0, 1e-17, -1e-17, 1e-16, -1e-16, 1e-15, -1e-15, 3e-13, -3e-13, 2e-12, -2e-12}) {
          const Point aside = off * Point(-along.y(), along.x()).normalized();
          for (const double before : {0.0, 0.3})
            for (const double behind : {0.0, 1e-9, 0.7}) {
              // A border that begins or ends in the element, by more than round-off, does not divide it.
              if (std::abs(off) > 1e-12 && (before == 0 || behind < 0.1)) continue;
              const Point begin = from - before * along + aside, end = to + behind * along + aside,
                          between = from + 0.4 * along + aside;
              // Of a strip beside the border, of a triangle at least 0.8 mm high; and of 1e-9 of an edge.
              const double accuracy = 2 * (stiff - soft) * std::abs(off) / 0.8e-3 + 3e-9;
              EXPECT_NEAR(mean_shear(triangle, from + aside, along, {{begin, end}}), mean, accuracy)
                  << turn << ' ' << first << ' ' << part << ' ' << off << ' ' << before << ' ' << behind;
              EXPECT_NEAR(mean_shear(triangle, from + aside, along, {{between, begin}, {end, between}}), mean, accuracy)
                  << "in two pieces: " << turn << ' ' << first << ' ' << part << ' ' << off;
            }
        }
      }
}

/// A border through two edges, in closed form, too.
TEST(CutElements, ABorderThroughTwoEdgesDividesTheElement) {
  for (const double turn : {0.0, 0.4, 1.9})
    for (int first = 0; first < 3; ++first)
      for (const double part : {1e-7, 1e-3, 0.3, 0.9})
        for (const double other : {1e-3, 0.5, 0.8}) {
          const Triangle triangle(turn, first);
          const Point& corner = triangle.corner[0];
          const Point from = corner + part * (triangle.corner[1] - corner),
                      to = corner + other * (triangle.corner[2] - corner), along = to - from;
          // The corner is to the left.
          const double mean = soft + part * other * (stiff - soft);
          EXPECT_NEAR(mean_shear(triangle, from, along, {{from - along, to + along}}), mean, 1e-9)
              << turn << ' ' << first << ' ' << part << ' ' << other;
        }
}

/// A border along an edge, in line with it but for round-off, or only at a corner, divides nothing.
TEST(CutElements, ABorderAlongAnEdgeOrAtACornerDividesNothing) {
  for (const double turn : {0.0, 0.4, 1.9})
    for (int first = 0; first < 3; ++first)
      for (const double off : {0.0, 1e-17, -1e-17, 1e-16, -1e-16}) {
        const Triangle triangle(turn, first);
        const auto& [a, b, c] = triangle.corner;
        const Point along = b - a, normal = Point(-along.y(), along.x()).normalized();
        const FineRock::Border in_line = {a - 0.4 * along + off * normal, b + 0.2 * along - off * normal},
                               at_corner = {a, a - along - 2 * (c - a)};
        for (const FineRock::Border& border : {in_line, at_corner})
          EXPECT_NEAR(mean_shear(triangle, a - normal, along, {border}), stiff, 1e-11)
              << turn << ' ' << first << ' ' << off;
      }
}

}  // namespace
}  // namespace sprekk::fine_fracture
