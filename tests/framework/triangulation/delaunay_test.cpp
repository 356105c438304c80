#include "framework/triangulation/delaunay.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <stdexcept>

#include "framework/mesh/mesh.hpp"
#include "framework/mesh/plane/planar.hpp"

namespace sprekk {
namespace {

Point onto_grid(double x, double y) { return Point(std::round(x * 0x1p32), std::round(y * 0x1p32)) * 0x1p-32; }

std::vector<Point> random_points(int count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-1, 1);
  std::vector<Point> points;
  for (int i = 0; i < count; ++i) {
    const double x = place(random);
    points.push_back(onto_grid(x, place(random)));
  }
  return points;
}

Delaunay triangulation_of(const std::vector<Point>& points) {
  Delaunay delaunay;
  for (const Point& x : points) delaunay.add(x);
  return delaunay;
}

/// Of the circle through a, b, c; a second way to compute it, with the digits of long double.
bool is_in_circle(const Point& a, const Point& b, const Point& c, const Point& x) {
  const Eigen::Matrix<long double, 2, 1> p = (b - a).cast<long double>(), q = (c - a).cast<long double>();
  const long double twice = 2 * (p.x() * q.y() - p.y() * q.x());
  const Eigen::Matrix<long double, 2, 1> center((q.y() * p.squaredNorm() - p.y() * q.squaredNorm()) / twice,
                                                (p.x() * q.squaredNorm() - q.x() * p.squaredNorm()) / twice);
  return ((x - a).cast<long double>() - center).norm() < center.norm() * (1 - 1e-9L);
}

double area(const Delaunay& delaunay) {
  double sum = 0;
  for (const auto& triangle : delaunay.triangles()) {
    const auto& [a, b, c] = triangle.corners;
    const double part = signed_area(delaunay.points()[a], delaunay.points()[b], delaunay.points()[c]);
    EXPECT_GT(part, 0);
    sum += part;
  }
  return sum;
}

bool has_edge(const Delaunay& delaunay, int from, int to) {
  return std::any_of(delaunay.triangles().begin(), delaunay.triangles().end(), [&](const auto& t) {
    for (int k = 0; k < 3; ++k)
      if (t.corners[k] == from && t.corners[(k + 1) % 3] == to) return true;
    return false;
  });
}

TEST(Delaunay, NoCircumcircleHasAPointInIt) {
  constexpr int count = 300;
  const Delaunay delaunay = triangulation_of(random_points(count));
  EXPECT_EQ(delaunay.triangles().size(), 2u * count + 2);  // Euler, with four points outside
  EXPECT_NEAR(area(delaunay), 256, 1e-11);
  for (const auto& triangle : delaunay.triangles()) {
    const auto& [a, b, c] = triangle.corners;
    for (const Point& x : delaunay.points())
      EXPECT_FALSE(is_in_circle(delaunay.points()[a], delaunay.points()[b], delaunay.points()[c], x));
  }
}

TEST(Delaunay, TriangleKnowsItsNeighbours) {
  const Delaunay delaunay = triangulation_of(random_points(100));
  const auto& triangles = delaunay.triangles();
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t)
    for (int k = 0; k < 3; ++k) {
      const int other = triangles[t].across[k];
      if (other == none) continue;
      std::set<int> shared(triangles[t].corners.begin(), triangles[t].corners.end());
      shared.insert(triangles[other].corners.begin(), triangles[other].corners.end());
      EXPECT_EQ(shared.size(), 4u);
      EXPECT_NE(std::find(triangles[other].across.begin(), triangles[other].across.end(), t),
                triangles[other].across.end());
    }
}

TEST(Delaunay, PointsOfALatticeAreNoSpecialCase) {
  // Four on each circle, and each point that is added lies on an edge, or nearly so.
  std::vector<Point> points;
  for (int i = -8; i <= 8; ++i)
    for (int j = -8; j <= 8; ++j) points.push_back(onto_grid(i / 8.0, j / 8.0 + i * 0x1p-32));
  const Delaunay delaunay = triangulation_of(points);
  EXPECT_EQ(delaunay.triangles().size(), 2 * points.size() + 2);
  EXPECT_NEAR(area(delaunay), 256, 1e-11);
}

TEST(Delaunay, FixedEdgesStay) {
  std::vector<Point> points = random_points(200);
  const auto away = [](const Point& x) { return std::abs(x.y() - 0.3 * x.x()); };
  points.erase(std::remove_if(points.begin(), points.end(), [&](const Point& x) { return away(x) < 0.01; }),
               points.end());
  points.push_back(onto_grid(-1, -0.3));
  points.push_back(onto_grid(1, 0.3));
  Delaunay delaunay = triangulation_of(points);
  const int from = static_cast<int>(points.size()) + 2, to = from + 1;
  ASSERT_FALSE(has_edge(delaunay, from, to));
  delaunay.fix(from, to, Delaunay::Edge::line);
  delaunay.restore();
  for (const Point& x : {Point(0.1, 0.05), Point(-0.5, -0.14), Point(0.75, 0.22)})
    delaunay.add(onto_grid(x.x(), x.y()));
  EXPECT_TRUE(has_edge(delaunay, from, to));
  EXPECT_TRUE(has_edge(delaunay, to, from));
  EXPECT_NEAR(area(delaunay), 256, 1e-11);
}

TEST(Delaunay, RefusesLinesThatCrossAndPointsThatAreTheSame) {
  Delaunay delaunay = triangulation_of({{-0.5, 0}, {0.5, 0}, {0, -0.5}, {0, 0.5}});
  delaunay.fix(4, 5, Delaunay::Edge::line);
  EXPECT_THROW(delaunay.fix(6, 7, Delaunay::Edge::line), std::runtime_error);
  EXPECT_THROW(delaunay.add({0.5, 0}), std::runtime_error);
  Delaunay with_middle = triangulation_of({{-0.5, 0}, {0.5, 0}, {0, 0}});
  EXPECT_THROW(with_middle.fix(4, 5, Delaunay::Edge::line), std::runtime_error);
}

}  // namespace
}  // namespace sprekk
