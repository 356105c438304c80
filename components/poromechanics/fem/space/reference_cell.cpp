#include "components/poromechanics/fem/reference_cell.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "components/poromechanics/fem/cell_edges.hpp"
#include "components/poromechanics/fem/gauss_points.hpp"
#include "framework/invariants.hpp"

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
Functions tetrahedron_functions(const Point& x, bool has_edges) {
  Functions functions{{1 - x.sum(), -Point::Ones()}};
  for (int k = 0; k < dimension; ++k) functions.push_back({x[k], Point::Unit(k)});
  const Functions corner = functions;
  if (has_edges)
    for (const auto& [from, to] : edges_of_shape(4)) functions.push_back(4 * (corner[from] * corner[to]));
  for (const FaceNodes& face : shape_with(4)->faces)
    functions.push_back(bubble(corner[face[0]], corner[face[1]], corner[face[2]]));
  functions.push_back(256 * (corner[0] * corner[1] * corner[2] * corner[3]));
  return functions;
}

/// On the unit triangle times the unit interval.
Functions wedge_functions(double xi, double eta, double zeta, bool has_edges) {
  const Triple corner = in_triangle(xi, eta);
  const Pair level = along(2, zeta);
  Functions functions;
  for (const ReferenceFunction& at : level)
    for (const ReferenceFunction& share : corner) functions.push_back(share * at);
  if (has_edges)
    for (const auto& [from, to] : edges_of_shape(6)) {
      const bool is_upright = from % 3 == to % 3;
      functions.push_back(is_upright ? corner[from % 3] * bump(level)
                                     : 4 * (corner[from % 3] * corner[to % 3]) * level[from / 3]);
    }
  const ReferenceFunction inside = bubble(corner[0], corner[1], corner[2]);
  for (const ReferenceFunction& at : level) functions.push_back(inside * at);
  for (int k = 0; k < 3; ++k) functions.push_back(4 * (corner[k] * corner[(k + 1) % 3]) * bump(level));
  functions.push_back(inside * bump(level));
  return functions;
}

/// On the unit cube. The corners are (0, 0), (1, 0), (1, 1), (0, 1) below, and then the same above.
Functions cube_functions(double xi, double eta, double zeta, bool has_edges) {
  const Pair along_axis[dimension] = {along(0, xi), along(1, eta), along(2, zeta)};
  const auto end_of = [](int corner, int axis) {
    const int around = corner % 4;
    return axis == 2 ? corner / 4 : axis == 1 ? around / 2 : int(around == 1 || around == 2);
  };
  // What is at the same end of an axis in all corners is so there, what is at both is a bump along it.
  const auto between = [&](const std::vector<int>& corners) {
    ReferenceFunction product{1, Point::Zero()};
    for (int axis = 0; axis < dimension; ++axis) {
      const int end = end_of(corners.front(), axis);
      const bool is_same = std::ranges::all_of(corners, [&](int corner) { return end_of(corner, axis) == end; });
      product = product * (is_same ? along_axis[axis][end] : bump(along_axis[axis]));
    }
    return product;
  };
  Functions functions;
  for (int corner = 0; corner < 8; ++corner) functions.push_back(between({corner}));
  if (has_edges)
    for (const auto& [from, to] : edges_of_shape(8)) functions.push_back(between({from, to}));
  for (const FaceNodes& face : shape_with(8)->faces) functions.push_back(between({face.begin(), face.end()}));
  functions.push_back(between({0, 1, 2, 3, 4, 5, 6, 7}));
  return functions;
}

/// 24 points, exact for polynomials of the sixth degree (Keast 1986, Moderate-degree tetrahedral quadrature formulas).
std::vector<ReferencePoint> tetrahedron_points(bool has_edges) {
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
        points.push_back({weight, tetrahedron_functions({share[1], share[2], share[3]}, has_edges)});
      }
  }
  return points;
}

/// Along rays from one or two corners (bits), or from one to the other three.
std::vector<ReferencePoint> tetrahedron_points_along_rays(unsigned from) {
  std::vector<int> near, far;
  for (int k = 0; k < 4; ++k) ((from >> k) & 1 ? near : far).push_back(k);
  if (near.size() > far.size()) std::swap(near, far);
  std::vector<ReferencePoint> points;
  for (const GaussPoint& along : four_gauss_points())
    for (const GaussPoint& first : four_gauss_points())
      for (const GaussPoint& second : four_gauss_points()) {
        std::array<double, 4> share{};
        double weight = along.weight * first.weight * second.weight;
        if (near.size() == 2) {
          share[near[0]] = (1 - along.at) * first.at;
          share[near[1]] = (1 - along.at) * (1 - first.at);
          share[far[0]] = along.at * second.at;
          share[far[1]] = along.at * (1 - second.at);
          weight *= along.at * (1 - along.at);
        } else {
          share[near[0]] = 1 - along.at;
          share[far[0]] = along.at * first.at;
          share[far[1]] = along.at * (1 - first.at) * second.at;
          share[far[2]] = along.at * (1 - first.at) * (1 - second.at);
          weight *= along.at * along.at * (1 - first.at);
        }
        points.push_back({weight, tetrahedron_functions({share[1], share[2], share[3]}, true)});
      }
  return points;
}

/// For each choice of corners.
std::vector<std::vector<ReferencePoint>> tetrahedra_with_edges() {
  std::vector<std::vector<ReferencePoint>> points;
  for (unsigned from = 0; from < 1 << 4; ++from)
    points.push_back(std::popcount(from) % 4 == 0 ? tetrahedron_points(true) : tetrahedron_points_along_rays(from));
  return points;
}

/// Exact for polynomials of the sixth degree along the triangle, and of the fifth across it.
std::vector<ReferencePoint> wedge_points(int start, bool has_edges) {
  std::vector<ReferencePoint> points;
  for (const GaussPoint& first : four_gauss_points())
    for (const GaussPoint& second : four_gauss_points())
      for (const GaussPoint& across : gauss_points()) {
        // A triangle is a square of which one side has no length.
        const double shrink = 1 - first.at;
        std::array<double, 3> share{};
        share[start] = first.at;
        share[(start + 1) % 3] = shrink * second.at;
        share[(start + 2) % 3] = shrink * (1 - second.at);
        points.push_back({first.weight * second.weight * across.weight * shrink,
                          wedge_functions(share[1], share[2], across.at, has_edges)});
      }
  return points;
}

std::vector<ReferencePoint> cube_points(bool has_edges) {
  std::vector<ReferencePoint> points;
  for (const GaussPoint& x : gauss_points())
    for (const GaussPoint& y : gauss_points())
      for (const GaussPoint& z : gauss_points())
        points.push_back({x.weight * y.weight * z.weight, cube_functions(x.at, y.at, z.at, has_edges)});
  return points;
}

}  // namespace

const std::vector<ReferencePoint>& reference_points(int corners, int start, bool has_edges) {
  SPREKK_EXPECT(shape_with(corners) != nullptr, corners);
  if (corners == 4) {
    static const std::vector<ReferencePoint> without = tetrahedron_points(false);
    static const std::vector<std::vector<ReferencePoint>> with = tetrahedra_with_edges();
    return has_edges ? with[start] : without;
  }
  if (corners == 6) {
    static const std::vector<ReferencePoint> without = wedge_points(1, false);
    static const std::array with{wedge_points(0, true), wedge_points(1, true), wedge_points(2, true)};
    return has_edges ? with[start] : without;
  }
  static const std::array cube{cube_points(false), cube_points(true)};  // without and with edges
  return cube[has_edges ? 1 : 0];
}

}  // namespace sprekk::poromechanics
