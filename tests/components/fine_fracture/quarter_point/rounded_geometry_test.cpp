// Fine levels whose geometries differ by round-off have meshes with the same topology, and nodes that differ by as
// much.
#include "components/fine_fracture/quarter_point/mesh/rounded_geometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "framework/mesh/plane/planar.hpp"
#include "tests/components/fine_fracture/quarter_point/cases.hpp"

namespace sprekk::test {
namespace {

constexpr double degree = std::numbers::pi / 180;
const FineMeshOptions sizes{.tip_size = 0.01, .far_size = 0.05};

Point turned(const Point& x, double angle) {
  return {std::cos(angle) * x.x() - std::sin(angle) * x.y(), std::sin(angle) * x.x() + std::cos(angle) * x.y()};
}

/// The crack of section 5.2 of the paper in the square around its right tip, with wings of increments of 10 mm that
/// bend by some degrees, the last one of any length.
FineGeometry wings(int increments, std::mt19937& random) {
  std::uniform_real_distribution<double> bend(-8, 8), part(0.1, 1.5);
  CrackPath crack{{}, true, true, {}};
  std::vector<Point> right{{0.05, 0}}, left{{-0.05, 0}};
  double angle = -60 * degree;
  for (int i = 0; i < increments; ++i) {
    const double length = 0.01 * (i + 1 < increments ? 1 : part(random));
    angle += bend(random) * degree;
    right.push_back(right.back() + length * Point(std::cos(angle), std::sin(angle)));
    left.push_back(left.back() - length * Point(std::cos(angle), std::sin(angle)));
  }
  crack.points.assign(left.rbegin(), left.rend());
  crack.points.insert(crack.points.end(), right.begin(), right.end());
  crack.walls.assign(crack.points.size() - 1, Walls::traction);
  const Point tip = right.back();
  return {rectangle(tip.x() - 0.25, tip.y() - 0.25, tip.x() + 0.25, tip.y() + 0.25), {crack}};
}

/// Each point of a geometry changed by a function.
FineGeometry changed(FineGeometry geometry, const std::function<Point(const Point&)>& change) {
  for (Point& x : geometry.outline) x = change(x);
  for (CrackPath& crack : geometry.cracks)
    for (Point& x : crack.points) x = change(x);
  return geometry;
}

std::vector<std::array<int, 6>> topology(const FineMesh& mesh) {
  std::vector<std::array<int, 6>> elements;
  for (const FineMesh::Element& element : mesh.elements) elements.push_back(element.nodes);
  return elements;
}

FineMesh rounded_mesh(const FineGeometry& geometry, const Point& anchor) {
  TriangulationKeeper keeper{anchor, nullptr};
  return make_fine_mesh(geometry, sizes, &keeper);
}

double node_difference(const FineMesh& one, const FineMesh& other) {
  double most = 0;
  for (std::size_t i = 0; i < one.nodes.size(); ++i) most = std::max(most, (one.nodes[i] - other.nodes[i]).norm());
  return most;
}

TEST(RoundedGeometry, RoundOffChangesNoTopology) {
  std::mt19937 random(5);
  constexpr double by = 1e-11;
  std::uniform_real_distribution<double> noise(-by, by);
  int other_without = 0;
  for (int i = 0; i < 24; ++i) {
    const double turn = std::array{0.0, 30.0, 45.0, 90.0}[i % 4] * degree;
    const bool is_mirrored = i % 3 == 1;
    const auto place = [&](const Point& x) { return turned({x.x(), is_mirrored ? -x.y() : x.y()}, turn); };
    FineGeometry geometry = changed(wings(1 + i % 5, random), place);
    if (is_mirrored) std::ranges::reverse(geometry.outline);
    const Point anchor = place({0.05, 0});
    const FineGeometry near =
        changed(geometry, [&](const Point& x) -> Point { return x + Point(noise(random), noise(random)); });
    const FineMesh one = rounded_mesh(geometry, anchor), other = rounded_mesh(near, anchor);
    ASSERT_EQ(topology(one), topology(other)) << i;
    EXPECT_LT(node_difference(one, other), 5 * by) << i;
    if (topology(make_fine_mesh(geometry, sizes)) != topology(make_fine_mesh(near, sizes))) ++other_without;
  }
  RecordProperty("without rounding, of 24", other_without);
  EXPECT_GT(other_without, 0);
}

TEST(RoundedGeometry, NodesLieOnTheGivenLines) {
  std::mt19937 random(7);
  for (int increments = 0; increments < 6; ++increments) {
    const FineGeometry geometry = wings(increments, random);
    const FineMesh mesh = rounded_mesh(geometry, {0.05, 0});
    // Tips and all points of paths to the bit, nodes between them on the lines.
    for (const FineMesh::Tip& tip : mesh.tips) {
      EXPECT_EQ(mesh.nodes[tip.node], tip.room.position);
      EXPECT_EQ(tip.room.position, tip.room.is_last ? geometry.cracks[0].points.back() : geometry.cracks[0].points[0]);
    }
    const auto away = [&](const Point& x) {
      double least = 1;
      for (std::size_t i = 0; i + 1 < geometry.cracks[0].points.size(); ++i)
        least = std::min(least, distance(x, Segment{geometry.cracks[0].points[i], geometry.cracks[0].points[i + 1]}));
      return least;
    };
    double length = 0, wanted = 0;
    for (const FineMesh::WallEdge& edge : mesh.wall_edges) {
      for (const int node : edge.nodes[0]) EXPECT_LT(away(mesh.nodes[node]), 1e-15);
      length += edge.to - edge.from;
    }
    for (std::size_t i = 0; i + 1 < geometry.cracks[0].points.size(); ++i)
      wanted += (geometry.cracks[0].points[i + 1] - geometry.cracks[0].points[i]).norm();
    EXPECT_NEAR(length, wanted, 1e-14);
    double area = 0;
    for (const FineMesh::Element& e : mesh.elements) {
      const double part = signed_area(mesh.nodes[e.nodes[0]], mesh.nodes[e.nodes[1]], mesh.nodes[e.nodes[2]]);
      EXPECT_GT(part, 0);
      area += part;
    }
    EXPECT_NEAR(area, 0.25, 1e-13);
  }
}

// Griffith's crack: moving by less than a thirtieth of an edge costs no accuracy.
TEST(RoundedGeometry, FactorsAreAsAccurate) {
  for (const double turn : {0.0, 17.0, 45.0}) {
    const Griffith exact = paper_crack(1e6, 2e6);
    FineGeometry geometry = paper_box();
    TriangulationKeeper keeper{{0.05, 0}, nullptr};
    // Turned about its middle the square stays as good; the exact displacement is that of the crack along x.
    geometry.outline = rectangle(-0.25 - 1e-3 * turn, -0.25, 0.25, 0.25 + 2e-3 * turn);
    const FineModel plain(geometry, paper_mesh(), table_1_rock);
    const FineModel rounded(geometry, paper_mesh(), table_1_rock, {}, std::make_shared<Profile>(), &keeper);
    const double before = worst_error(plain.solve(exact_outline(exact)), exact.K()),
                 after = worst_error(rounded.solve(exact_outline(exact)), exact.K());
    EXPECT_LT(after, std::max(1.5 * before, 1e-4)) << turn;
  }
}

// Both tips of a point-symmetric crack have the same mesh, turned by half a turn.
TEST(RoundedGeometry, HalfATurnAndAShiftGiveTheSameMesh) {
  std::mt19937 random(11);
  const FineGeometry geometry = wings(4, random);
  const Point shift(0.3, -0.7);
  FineGeometry image = changed(geometry, [&](const Point& x) -> Point { return shift - x; });
  const FineMesh one = rounded_mesh(geometry, {0.05, 0}), other = rounded_mesh(image, shift - Point(0.05, 0));
  ASSERT_EQ(one.elements.size(), other.elements.size());
  double worst = 0;
  for (const Point& x : one.nodes) {
    double least = 1;
    for (const Point& y : other.nodes) least = std::min(least, (shift - x - y).norm());
    worst = std::max(worst, least);
  }
  EXPECT_LT(worst, 1e-12);
}

// A short last segment, straight but for its last digits: its end is a point of the mesh however small the bend is.
TEST(RoundedGeometry, NearlyStraightPathsHaveOneTopology) {
  const auto with_bend = [](double bend) {
    FineGeometry geometry = paper_box();
    geometry.cracks[0] = {
        {{-0.05, 0}, {0.045, 0}, {0.05, 0.005 * bend}}, true, true, {Walls::traction, Walls::traction}};
    return geometry;
  };
  const FineMesh straight = rounded_mesh(with_bend(0), {0.05, 0});
  EXPECT_NEAR(straight.tips.at(1).room.radius, 0.0025, 1e-15);
  for (const double bend : {1e-12, -1e-9, 3e-9, 1e-6, -1e-5}) {
    const FineMesh bent = rounded_mesh(with_bend(bend), {0.05, 0});
    ASSERT_EQ(topology(straight), topology(bent)) << bend;
    EXPECT_LT(node_difference(straight, bent), 0.01 * std::abs(bend) + 1e-15) << bend;
  }
}

}  // namespace
}  // namespace sprekk::test
