#include "framework/remeshing/overlap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "framework/mesh/plane/planar.hpp"
#include "framework/meshing/generate_mesh.hpp"
#include "tests/framework/mesh/mesh_checks.hpp"

namespace sprekk::test {
namespace {

const Corners half_square{Point(0, 0), Point(1, 0), Point(0, 1)};

Corners moved(const Corners& corners, const Point& by) { return {corners[0] + by, corners[1] + by, corners[2] + by}; }

TEST(CommonArea, ClosedForms) {
  EXPECT_EQ(common_area(half_square, half_square), 0.5);
  // Moved along x by t, the common part is the triangle of side 1 - t.
  for (const double t : {0.1, 0.25, 0.9}) {
    EXPECT_NEAR(common_area(half_square, moved(half_square, {t, 0})), 0.5 * (1 - t) * (1 - t), 1e-16);
  }
  // Two triangles that make a six-pointed star share a hexagon: two thirds of either.
  const double h = std::sqrt(3.0) / 2;
  const Corners up{Point(-0.5, -h / 3), Point(0.5, -h / 3), Point(0, 2 * h / 3)};
  const Corners down{Point(0.5, h / 3), Point(-0.5, h / 3), Point(0, -2 * h / 3)};
  EXPECT_NEAR(common_area(up, down), 2. / 3 * h / 2, 1e-16);
  EXPECT_EQ(common_area(half_square, moved(half_square, {2, 0})), 0);
  // In one line only.
  EXPECT_EQ(common_area(half_square, {Point(1, 0), Point(1, 1), Point(0, 1)}), 0);
  // One within the other.
  EXPECT_NEAR(common_area({Point(-9, -9), Point(9, -9), Point(0, 9)}, half_square), 0.5, 1e-15);
}

TEST(CommonArea, SmallTrianglesFarAway) {
  const double small = std::exp2(-20);
  Corners a = half_square, b = moved(half_square, {0.25, 0.125});
  const double area = common_area(a, b);
  for (Corners* corners : {&a, &b}) {
    for (Point& x : *corners) x = Point(1000, -3000) + small * x;  // exact: powers of two
  }
  EXPECT_NEAR(common_area(a, b), small * small * area, 1e-15 * small * small);
}

TEST(ForEachOverlap, SumsToTheAreasOfTwoMeshes) {
  const Mesh one = generate_mesh(paper_geometry(), {.size = 0.1, .tip_size = 0.01});
  const Mesh two = generate_mesh(box(0, 2, 0, 2), {.size = 0.07});
  const auto corners = [](const Mesh& mesh) {
    std::vector<Corners> all;
    for (const Ring& t : mesh.cell_nodes) all.push_back({mesh.nodes[t[0]], mesh.nodes[t[1]], mesh.nodes[t[2]]});
    return all;
  };
  std::vector<double> of_one = one.cell_measure, of_two = two.cell_measure;
  std::pair<int, int> last{-1, -1};
  for_each_overlap(corners(one), corners(two), [&](int i, int j, double area) {
    EXPECT_LT(last, std::pair(i, j));
    last = {i, j};
    of_one[i] -= area;
    of_two[j] -= area;
  });
  for (int i = 0; i < one.cell_count(); ++i) EXPECT_NEAR(of_one[i], 0, 1e-12 * one.cell_measure[i]);
  for (int j = 0; j < two.cell_count(); ++j) EXPECT_NEAR(of_two[j], 0, 1e-12 * two.cell_measure[j]);
}

}  // namespace
}  // namespace sprekk::test
