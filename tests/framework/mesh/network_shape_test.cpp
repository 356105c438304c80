#include "framework/mesh/quality/network_shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/meshing/generate_mesh.hpp"

namespace sprekk::test {
namespace {

Point turned(const Point& x, double angle) {
  const Point about(5, 5);
  const Point r = x - about;
  return about +
         Point(std::cos(angle) * r.x() - std::sin(angle) * r.y(), std::sin(angle) * r.x() + std::cos(angle) * r.y());
}

/// A triangle of three fractures with corners beyond which they go on, and a fourth one apart, turned by an angle.
Mesh three_fractures(double angle) {
  Geometry geometry;
  geometry.box = {{0, 0}, {10, 10}, {}};
  const auto add = [&](const std::string& name, const Point& from, const Point& to) {
    geometry.fractures.push_back({name, {turned(from, angle), turned(to, angle)}, std::nullopt, {}});
  };
  add("base", {3.5, 4}, {6.5, 4});
  add("left", {3.7, 3.7}, {6.3, 6.3});   // at 45 degrees, through (4, 4)
  add("right", {5.7, 6.1}, {6.1, 3.7});  // from the left one, past the base
  add("apart", {2, 8}, {4, 8.5});
  return generate_mesh(geometry, {.size = 1.5, .fracture_size = 0.6});
}

TEST(NetworkShape, FindsThePocketOfATriangle) {
  for (const double angle : {0.0, 0.4, 2.0}) {
    const Mesh mesh = three_fractures(angle);
    const std::vector<Pocket> found = pockets(mesh);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].fractures, (std::vector<int>{0, 1, 2}));
    // Its corners: (4, 4), and where the right one crosses the others: x = 6.05 at y = 4, and y = x at
    // 5.7 + (6.1 - y)/6 = y.
    const double top = (5.7 + 6.1 / 6) * 6 / 7;
    EXPECT_NEAR(found[0].measure, 0.5 * (6.05 - 4) * (top - 4), 1e-12);
    const Point center = turned(Point((4 + 6.05 + top) / 3, (4 + 4 + top) / 3), angle);
    EXPECT_LT((found[0].center - center).norm(), 1e-12);
    int inside = 0;
    for (const Point& x : mesh.cell_center) {
      const Point y = turned(x, -angle);
      inside += y.y() > 4 && y.x() > y.y() && y.x() < 6.05 - (y.y() - 4) / 6;
    }
    EXPECT_EQ(found[0].cells, inside);
  }
}

TEST(NetworkShape, FindsTheAnglesOfJunctions) {
  for (const double angle : {0.0, 0.4, 2.0}) {
    std::vector<double> degrees;
    for (const FractureAngle& junction : angles_of_junctions(three_fractures(angle))) {
      EXPECT_NE(junction.one, junction.other);
      degrees.push_back(junction.angle * 180 / std::numbers::pi);
    }
    std::ranges::sort(degrees);
    ASSERT_EQ(degrees.size(), 3u);
    const double right = std::atan2(6, -1) * 180 / std::numbers::pi;  // of the right one, from the x axis
    EXPECT_NEAR(degrees[0], 45, 1e-9);
    EXPECT_NEAR(degrees[1], right - 45, 1e-9);
    EXPECT_NEAR(degrees[2], 180 - right, 1e-9);
  }
}

TEST(NetworkShape, FracturesThatReachTheSidesMakeNoPocket) {
  Geometry geometry;
  geometry.box = {{0, 0}, {4, 4}, {}};
  for (const double at : {1.0, 3.0}) {
    geometry.fractures.push_back({"x" + std::to_string(at), {{at, 0}, {at, 4}}, std::nullopt, {}});
    geometry.fractures.push_back({"y" + std::to_string(at), {{0, at}, {4, at}}, std::nullopt, {}});
  }
  const Mesh mesh = generate_mesh(geometry, {.kind = MeshOptions::Kind::structured, .size = 1});
  const std::vector<Pocket> found = pockets(mesh);  // the one in the middle; the eight others have a side
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].measure, 4, 1e-14);
  EXPECT_EQ(found[0].cells, 8);
}

}  // namespace
}  // namespace sprekk::test
