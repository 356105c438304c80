// The pressure around tips keeps the means of cells, and has the sqrt(r) of the pressure at a tip that fluid leaves.
#include "couplers/two_level/pressure_near_tips.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>
#include <random>

#include "tests/components/meshes.hpp"

namespace sprekk::test {
namespace {

using couplers::PressureNearTips;
using Function = std::function<double(const Point&)>;

const Point tip(0.52, 0.47);

/// A square with a fracture from its left side to a tip, at the given angle.
Mesh with_tip(double size, double angle) {
  Geometry geometry = box(1, 1);
  geometry.fractures.emplace_back();
  geometry.fractures[0].name = "one";
  geometry.fractures[0].points = {tip + 0.52 / std::cos(angle) * Point(-std::cos(angle), -std::sin(angle)), tip};
  geometry.fractures[0].points[0][0] = 0;
  return generate_mesh(geometry, unstructured(size, 0.2));
}

/// Re sqrt(z) around the tip: zero on the fracture.
Function root(double angle) {
  return [angle](const Point& x) {
    return std::sqrt(std::complex<double>(x[0] - tip[0], x[1] - tip[1]) * std::polar(1.0, -angle)).real();
  };
}

double integral(const Point& a, const Point& b, const Point& c, const Function& f, int depth) {
  const double area = 0.5 * std::abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
  const Point ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
  const double away = ((a + b + c) / 3 - tip).norm(), size = std::max({(a - b).norm(), (b - c).norm(), (c - a).norm()});
  if (depth == 0 || size < 0.2 * away) return area / 3 * (f(ab) + f(bc) + f(ca));
  return integral(a, ab, ca, f, depth - 1) + integral(ab, b, bc, f, depth - 1) + integral(ca, bc, c, f, depth - 1) +
         integral(ab, bc, ca, f, depth - 1);
}

PressureNearTips::Given given(const Mesh& mesh, const Function& f) {
  PressureNearTips::Given given{Vector(mesh.cell_count()), {}, Vector(mesh.node_count())};
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    const Ring& nodes = mesh.cell_nodes[cell];
    given.cells[cell] =
        integral(mesh.nodes[nodes[0]], mesh.nodes[nodes[1]], mesh.nodes[nodes[2]], f, 12) / mesh.cell_measure[cell];
  }
  for (int wall = 0; wall < mesh.wall_count(); ++wall) given.walls.push_back(f(mesh.fracture_cells[wall / 2].center));
  for (int node = 0; node < mesh.node_count(); ++node) given.nodes[node] = f(mesh.nodes[node]);
  return given;
}

/// The largest error in the cells around the tip, and the mean of each cell over that which was given, less 1.
struct Errors {
  double largest = 0, mean = 0;
  int places = 0;
};
Errors errors(const Mesh& mesh, const Function& f) {
  PressureNearTips near(mesh);
  const PressureNearTips::Given all = given(mesh, f);
  near.set(all);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(0, 1);
  Errors errors;
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    const Ring& nodes = mesh.cell_nodes[cell];
    const Point &a = mesh.nodes[nodes[0]], &b = mesh.nodes[nodes[1]], &c = mesh.nodes[nodes[2]];
    if (!near.place(cell, mesh.cell_center[cell])) continue;
    ++errors.places;
    for (int i = 0; i < 20; ++i) {
      const double s = part(random), t = (1 - s) * part(random);
      const Point x = a + s * (b - a) + t * (c - a);
      errors.largest = std::max(errors.largest, std::abs(near.at(*near.place(cell, x)).value - f(x)));
    }
    // Midpoints of many small triangles.
    constexpr int n = 60;
    double sum = 0;
    int count = 0;
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n - i; ++k)
        for (const double third : {1.0 / 3, 2.0 / 3}) {
          if (third > 0.5 && i + k + 1 >= n) continue;
          const Point x = a + (i + third) / n * (b - a) + (k + third) / n * (c - a);
          sum += near.at(*near.place(cell, x)).value;
          ++count;
        }
    errors.mean = std::max(errors.mean, std::abs(sum / count - all.cells[cell]));
  }
  return errors;
}

// Along a fracture the pressure of a wall is that of the middle of its cell up to a tip.
TEST(PressureNearTips, IsLinearWhereThePressureIs) {
  for (const double angle : {0.0, 0.4}) {
    const Point normal(-std::sin(angle), std::cos(angle));
    const Errors found = errors(with_tip(0.1, angle), [&](const Point& x) { return 2 - 3 * normal.dot(x - tip); });
    EXPECT_GT(found.places, 20);
    EXPECT_LT(found.largest, 1e-12) << angle;
    EXPECT_LT(found.mean, 1e-12) << angle;
  }
}

TEST(PressureNearTips, HasTheRootAtATip) {
  for (const double angle : {0.0, 0.4}) {
    for (const double size : {0.1, 0.05}) {
      const Errors found = errors(with_tip(size, angle), root(angle));
      // Between the tip and the first node at r_1, a sixteenth of an edge, a linear function is sqrt(r_1)/4 too small.
      // Edges are up to 1.5 times as long as asked for.
      EXPECT_LT(found.largest, std::sqrt(1.5 * size / 16) / 4) << angle << " " << size;
      EXPECT_LT(found.mean, 3e-4 * std::sqrt(size)) << angle << " " << size;
    }
  }
}

}  // namespace
}  // namespace sprekk::test
