#include "components/poromechanics/fem/reference_cell.hpp"

#include <array>

#include "components/poromechanics/fem/gauss_points.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/shapes.hpp"

namespace sprekk::poromechanics {

namespace {

using Functions = std::vector<ReferenceFunction>;

/// The shares of a point in the ends of an edge, in the corners of a triangle and of a tetrahedron.
using Pair = std::array<ReferenceFunction, 2>;
using Triple = std::array<ReferenceFunction, 3>;

Pair along(int axis, double at) { return {{{1 - at, -Point::Unit(axis)}, {at, Point::Unit(axis)}}}; }
ReferenceFunction bump(const Pair& ends) { return 4 * (ends[0] * ends[1]); }

Triple in_triangle(double xi, double eta) { return {{{1 - xi - eta, {-1, -1, 0}}, {xi, {1, 0, 0}}, {eta, {0, 1, 0}}}}; }
ReferenceFunction bubble(const ReferenceFunction& a, const ReferenceFunction& b, const ReferenceFunction& c) {
  return 27 * (a * b * c);
}

/// On the tetrahedron of the origin and the unit vectors.
Functions tetrahedron_functions(const Point& x) {
  Functions functions{{1 - x.sum(), -Point::Ones()}};
  for (int k = 0; k < dimension; ++k) functions.push_back({x[k], Point::Unit(k)});
  for (const FaceNodes& face : shape_with(4)->faces)
    functions.push_back(bubble(functions[face[0]], functions[face[1]], functions[face[2]]));
  functions.push_back(256 * (functions[0] * functions[1] * functions[2] * functions[3]));
  return functions;
}

/// On the unit triangle times the unit interval.
Functions wedge_functions(double xi, double eta, double zeta) {
  const Triple corner = in_triangle(xi, eta);
  const Pair level = along(2, zeta);
  Functions functions;
  for (const ReferenceFunction& at : level)
    for (const ReferenceFunction& share : corner) functions.push_back(share * at);
  const ReferenceFunction inside = bubble(corner[0], corner[1], corner[2]);
  for (const ReferenceFunction& at : level) functions.push_back(inside * at);
  for (int k = 0; k < 3; ++k) functions.push_back(4 * (corner[k] * corner[(k + 1) % 3]) * bump(level));
  functions.push_back(inside * bump(level));
  return functions;
}

/// On the unit cube.
Functions cube_functions(double xi, double eta, double zeta) {
  const Pair x = along(0, xi), y = along(1, eta), z = along(2, zeta);
  const ReferenceFunction in_x = bump(x), in_y = bump(y), in_z = bump(z);
  Functions functions;
  for (const ReferenceFunction& level : z)
    for (const auto& [i, j] : {std::pair{0, 0}, std::pair{1, 0}, std::pair{1, 1}, std::pair{0, 1}})
      functions.push_back(x[i] * y[j] * level);
  // In the order of the faces of shape_with(8): below, above, in front, to the right, behind, to the left.
  for (const ReferenceFunction& level : z) functions.push_back(in_x * in_y * level);
  functions.push_back(in_x * y[0] * in_z);
  functions.push_back(x[1] * in_y * in_z);
  functions.push_back(in_x * y[1] * in_z);
  functions.push_back(x[0] * in_y * in_z);
  functions.push_back(in_x * in_y * in_z);
  return functions;
}

/// 24 points, exact for polynomials of the sixth degree (Keast 1986, Moderate-degree tetrahedral quadrature formulas).
std::vector<ReferencePoint> tetrahedron_points() {
  struct Orbit {
    double a, b, weight;  // of the shares in the corners two or three are a, one is b, and one is the rest
  };
  static constexpr Orbit orbits[] = {{0.2146028712591517, 0.2146028712591517, 0.006653791709694646},
                                     {0.0406739585346114, 0.0406739585346114, 0.00167953517588678},
                                     {0.3223378901422757, 0.3223378901422757, 0.009226196923942399},
                                     {0.0636610018750175, 0.2696723314583159, 9.0 / 1120}};
  std::vector<ReferencePoint> points;
  for (const auto& [a, b, weight] : orbits) {
    const double rest = 1 - 2 * a - b;
    for (int place = 0; place < 4; ++place)
      for (int other = 0; other < 4; ++other) {
        if (a == b ? other != (place + 1) % 4 : other == place) continue;
        std::array<double, 4> share{a, a, a, a};
        share[place] = rest;
        share[other] = b;
        points.push_back({weight, tetrahedron_functions({share[1], share[2], share[3]})});
      }
  }
  return points;
}

/// Exact for polynomials of the sixth degree along the triangle, and of the fifth across it.
std::vector<ReferencePoint> wedge_points() {
  std::vector<ReferencePoint> points;
  for (const GaussPoint& first : four_gauss_points())
    for (const GaussPoint& second : four_gauss_points())
      for (const GaussPoint& across : gauss_points()) {
        // A triangle is a square of which one side has no length.
        const double shrink = 1 - first.at;
        points.push_back({first.weight * second.weight * across.weight * shrink,
                          wedge_functions(first.at, shrink * second.at, across.at)});
      }
  return points;
}

std::vector<ReferencePoint> cube_points() {
  std::vector<ReferencePoint> points;
  for (const GaussPoint& x : gauss_points())
    for (const GaussPoint& y : gauss_points())
      for (const GaussPoint& z : gauss_points())
        points.push_back({x.weight * y.weight * z.weight, cube_functions(x.at, y.at, z.at)});
  return points;
}

}  // namespace

const std::vector<ReferencePoint>& reference_points(int corners, int /*start*/) {
  SPREKK_EXPECT(shape_with(corners) != nullptr, corners);
  static const std::vector<ReferencePoint> tetrahedron = tetrahedron_points(), wedge = wedge_points(),
                                           cube = cube_points();
  return corners == 4 ? tetrahedron : corners == 6 ? wedge : cube;
}

}  // namespace sprekk::poromechanics
