// The pressure around tips keeps the means of cells, and has the sqrt(r) of the pressure at a tip that fluid leaves.
#include "couplers/two_level/plane/pressure_near_tips.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>
#include <random>
#include <string>

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

/// The mean over a cell, from the midpoints of many small triangles.
double mean_over(const Mesh& mesh, int cell, const Function& f) {
  const Ring& nodes = mesh.cell_nodes[cell];
  const Point &a = mesh.nodes[nodes[0]], &b = mesh.nodes[nodes[1]], &c = mesh.nodes[nodes[2]];
  constexpr int n = 60;
  double sum = 0;
  int count = 0;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n - i; ++k)
      for (const double third : {1.0 / 3, 2.0 / 3}) {
        if (third > 0.5 && i + k + 1 >= n) continue;
        sum += f(a + (i + third) / n * (b - a) + (k + third) / n * (c - a));
        ++count;
      }
  return sum / count;
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
    const double mean = mean_over(mesh, cell, [&](const Point& x) { return near.at(*near.place(cell, x)).value; });
    errors.mean = std::max(errors.mean, std::abs(mean - all.cells[cell]));
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

// Rings that touch are one region: its cost is that of a sparse system, however many tips it has.
TEST(PressureNearTips, OfManyTipsIsLinearWhereThePressureIs) {
  Geometry geometry = box(1, 1);
  for (int row = 0; row < 8; ++row)
    for (int column = 0; column < 8; ++column) {
      const double x = 0.09 + 0.11 * column, y = 0.11 + 0.11 * row;
      geometry.fractures.emplace_back();
      geometry.fractures.back().name = "f" + std::to_string(8 * row + column);
      geometry.fractures.back().points = {{x, y}, {x + 0.05, y}};
    }
  const Mesh mesh = generate_mesh(geometry, unstructured(0.02, 0.2));
  const auto f = [](const Point& x) { return 2 - 3 * x[1]; };
  PressureNearTips near(mesh);
  near.set(given(mesh, f));
  int places = 0;
  for (int cell = 0; cell < mesh.cell_count(); ++cell)
    if (const auto place = near.place(cell, mesh.cell_center[cell])) {
      ++places;
      const PressureNearTips::Value found = near.at(*place);
      EXPECT_NEAR(found.value, f(mesh.cell_center[cell]), 1e-12);
      EXPECT_DOUBLE_EQ(found.weight, 1);
    }
  EXPECT_GT(places, 3000);
}

// A pressure that falls from 1 at the walls to 0 over a small part of a cell makes means that do not tell how it falls.
TEST(PressureNearTips, CountsLessTheThinnerTheFrontIs) {
  constexpr double size = 0.05;
  for (const double angle : {0.0, 0.4}) {
    const Mesh mesh = with_tip(size, angle);
    const Point along(std::cos(angle), std::sin(angle));
    const auto weight = [&](double thickness) {
      const auto f = [&](const Point& x) {
        const double ahead = along.dot(x - tip);
        const double distance =
            ahead > 0 ? (x - tip).norm() : std::abs(along[0] * (x - tip)[1] - along[1] * (x - tip)[0]);
        return std::exp(-distance / thickness);
      };
      PressureNearTips near(mesh);
      PressureNearTips::Given all = given(mesh, f);
      int last = 0;
      for (int cell = 0; cell < mesh.cell_count(); ++cell)
        if (near.place(cell, mesh.cell_center[cell])) all.cells[last = cell] = mean_over(mesh, cell, f);
      near.set(all);
      return near.at(*near.place(last, mesh.cell_center[last])).weight;
    };
    EXPECT_DOUBLE_EQ(weight(2 * size), 1);
    EXPECT_DOUBLE_EQ(weight(0.02 * size), 0);
    double before = 1;
    int between = 0;
    for (double thickness = size; thickness > 0.02 * size; thickness *= 0.8) {
      const double now = weight(thickness), next = weight((1 + 1e-6) * thickness);
      EXPECT_LE(now, before + 1e-12) << angle << " " << thickness;
      EXPECT_NEAR(now, next, 1e-4) << angle << " " << thickness;
      between += now > 0 && now < 1;
      before = now;
    }
    EXPECT_GE(between, 2) << angle;
  }
}

}  // namespace
}  // namespace sprekk::test
