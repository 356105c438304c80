#include "framework/triangulation/mesh_region.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <stdexcept>

#include "framework/mesh/plane/planar.hpp"

namespace sprekk {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double good = 20.7 * degree;  ///< what Delaunay refinement by circumcentres reaches (Ruppert 1995)

Point onto_grid(double x, double y) { return Point(std::round(x * 0x1p32), std::round(y * 0x1p32)) * 0x1p-32; }

RegionDrawing square() {
  RegionDrawing drawing{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {}};
  for (int i = 0; i < 4; ++i) drawing.lines.push_back({{i, (i + 1) % 4}, true, false});
  return drawing;
}

void add_line(RegionDrawing& drawing, const Point& from, const Point& to) {
  const int first = static_cast<int>(drawing.points.size());
  drawing.points.insert(drawing.points.end(), {from, to});
  drawing.lines.push_back({{first, first + 1}, false, false});
}

struct Shapes {
  double area = 0, smallest = std::numeric_limits<double>::infinity(), mean = 0;  ///< of the smallest angles, rad
};

Shapes shapes(const RegionMesh& mesh) {
  Shapes shapes;
  for (const Ring& t : mesh.triangles) {
    const Point &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    EXPECT_GT(signed_area(a, b, c), 0);
    shapes.area += signed_area(a, b, c);
    shapes.smallest = std::min(shapes.smallest, smallest_angle(a, b, c));
    shapes.mean += smallest_angle(a, b, c) / static_cast<double>(mesh.triangles.size());
  }
  return shapes;
}

std::set<std::pair<int, int>> edges(const RegionMesh& mesh) {
  std::set<std::pair<int, int>> edges;
  for (const Ring& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) edges.insert({t[k], t.after(k)});
  return edges;
}

TEST(MeshRegion, FillsASquareWithNearlyEquilateralTriangles) {
  for (const double size : {0.3, 0.1, 0.03}) {
    const RegionMesh mesh = mesh_region(square(), [size](const Point&) { return size; });
    const Shapes found = shapes(mesh);
    EXPECT_NEAR(found.area, 4, 1e-12);
    EXPECT_GT(found.smallest, good);
    EXPECT_GT(found.mean, 45 * degree);
    const double expected = 4 / (std::numbers::sqrt3 / 4 * size * size);
    EXPECT_NEAR(mesh.triangles.size() / expected, 1, 0.2) << size;
  }
}

TEST(MeshRegion, EdgesHaveTheWantedLengths) {
  RegionDrawing drawing = square();
  add_line(drawing, {-0.5, 0.25}, {0.25, 0.25});
  const auto size = [](const Point& x) { return 1e-3 + 0.3 * (x - Point(0.25, 0.25)).norm(); };
  const RegionMesh mesh = mesh_region(drawing, size);
  EXPECT_GT(shapes(mesh).smallest, good);
  double mean = 0;
  const auto found = edges(mesh);
  for (const auto& [a, b] : found) {
    const double ratio = (mesh.points[a] - mesh.points[b]).norm() / size(0.5 * (mesh.points[a] + mesh.points[b]));
    EXPECT_GT(ratio, 0.4);
    EXPECT_LT(ratio, 2);
    mean += ratio / static_cast<double>(found.size());
  }
  EXPECT_NEAR(mean, 1, 0.15);
}

TEST(MeshRegion, LeavesHolesAndFollowsLines) {
  RegionDrawing drawing = square();
  constexpr int sectors = 12;
  const double radius = 0.125;
  std::vector<Point> hole;
  for (int k = 0; k < sectors; ++k) {
    const double angle = 2 * std::numbers::pi * k / sectors;
    hole.push_back(onto_grid(radius * std::cos(angle), radius * std::sin(angle)));
    drawing.lines.push_back({{4 + k, 4 + (k + 1) % sectors}, true, true});
  }
  drawing.points.insert(drawing.points.end(), hole.begin(), hole.end());
  add_line(drawing, {-0.75, 0.5}, {0.75, 0.25});
  const RegionMesh mesh = mesh_region(drawing, [](const Point& x) { return 0.02 + 0.3 * x.norm(); });
  EXPECT_NEAR(shapes(mesh).area, 4 - signed_area(hole), 1e-12);
  const auto found = edges(mesh);
  for (std::size_t l = 0; l < drawing.lines.size(); ++l) {
    const std::vector<int>& line = mesh.on_line[l];
    EXPECT_EQ(line.front(), drawing.lines[l].points[0]);
    EXPECT_EQ(line.back(), drawing.lines[l].points[1]);
    EXPECT_TRUE(!drawing.lines[l].is_whole || line.size() == 2);
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const bool forth = found.contains({line[i], line[i + 1]}), back = found.contains({line[i + 1], line[i]});
      EXPECT_EQ(forth + back, drawing.lines[l].is_boundary ? 1 : 2);
    }
  }
  for (std::size_t i = 0; i < drawing.points.size(); ++i) EXPECT_EQ(mesh.points[i], drawing.points[i]);
  EXPECT_GT(mesh.on_line.back().size(), 4u);
}

TEST(MeshRegion, SizesGrowFromLinesThatAreShort) {
  RegionDrawing drawing = square();
  add_line(drawing, {-0x1p-10, 0}, {0x1p-10, 0});  // 0.002 long
  EXPECT_GT(shapes(mesh_region(drawing, [](const Point&) { return 0.2; })).smallest, good);
}

TEST(MeshRegion, RefusesLinesThatCross) {
  RegionDrawing drawing = square();
  add_line(drawing, {-0.5, -0.5}, {0.5, 0.5});
  add_line(drawing, {-0.5, 0.5}, {0.5, -0.4});
  EXPECT_THROW(mesh_region(drawing, [](const Point&) { return 0.1; }), std::runtime_error);
}

TEST(MeshRegion, RefusesBoundariesThatAreNotClosed) {
  const auto size = [](const Point&) { return 0.5; };
  RegionDrawing open = square(), leaking = square();
  open.lines.pop_back();
  leaking.lines[2].is_boundary = false;
  for (const RegionDrawing& drawing : {open, leaking}) EXPECT_THROW(mesh_region(drawing, size), std::runtime_error);
}

}  // namespace
}  // namespace sprekk
