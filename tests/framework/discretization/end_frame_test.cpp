// On which side of a fracture that kinks points lie, and their polar coordinates around its end.
#include "framework/discretization/end_frame.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "framework/discretization/plane/end_surroundings.hpp"
#include "framework/mesh/build_mesh.hpp"
#include "framework/meshing/generate_mesh.hpp"
#include "tests/framework/mesh/mesh_checks.hpp"

namespace sprekk::test {
namespace {

Point turned(const Point& x, double by) {
  return {std::cos(by) * x[0] - std::sin(by) * x[1], std::sin(by) * x[0] + std::cos(by) * x[1]};
}

/// A fracture along x, turned by an angle, with a kink at the origin and a wing of 0.3 m at its end.
struct Kinked {
  Mesh mesh;
  int end = none;
  double turn, kink;

  Kinked(double turn, double kink) : turn(turn), kink(kink) {
    Geometry geometry = box(-2, 2, -2, 2);
    geometry.fractures = {fracture("crack", {place(-1, 0), place(0, 0), tip()})};
    mesh = generate_mesh(geometry, {.size = 0.5, .fracture_size = 0.1});
    for (int node = 0; node < mesh.node_count(); ++node)
      if (is_fracture_end(mesh, node) && (mesh.nodes[node] - tip()).norm() < 1e-12) end = node;
  }
  Point place(double x, double y) const { return turned({x, y}, turn); }
  Point tip() const { return turned({0.3, 0}, turn + kink); }
};

class KinkedFracture : public ::testing::TestWithParam<double> {};

// The line through the last wall leaves the fracture at the kink, and lies in the rock on one side of it. There nothing
// changes; on the fracture sides do.
TEST_P(KinkedFracture, HasSidesThatChangeOnItAlone) {
  for (const double turn : {0.0, 0.5, 2.0, -2.8}) {
    const Kinked crack(turn, GetParam());
    ASSERT_NE(crack.end, none);
    const EndFrame frame(crack.mesh, crack.end);
    const int left = GetParam() > 0 ? 1 : -1;  // the side to which the wing turns
    const auto angle = [&](const Point& x) { return frame.polar(x, frame.side_of(x)).angle; };
    const Point along = turned({1, 0}, turn + GetParam()), aside = turned({0, 1e-9}, turn + GetParam());
    for (const double behind : {0.02, 0.1, 0.5}) {
      const Point x = -behind * along;
      EXPECT_EQ(frame.side_of(x + aside), -left) << turn;
      EXPECT_EQ(frame.side_of(x - aside), -left) << turn;
      EXPECT_NEAR(angle(x + aside), angle(x - aside), 1e-7) << turn;
      EXPECT_NEAR(angle(x + aside), -left * std::numbers::pi, 1e-7) << turn;
    }
    for (const double at : {-0.9, -0.35, -0.02})
      for (const int side : {1, -1}) EXPECT_EQ(frame.side_of(crack.place(at, side * 1e-3)), side) << turn;
    for (const double at : {0.01, 0.2})
      for (const int side : {1, -1}) {
        const Point x = at * along + side * 1e6 * aside;
        EXPECT_EQ(frame.side_of(x), side) << turn;
        EXPECT_NEAR(angle(x), side * std::numbers::pi, 0.2);
      }
    // Ahead of the end the fracture has no sides, and angles go through zero.
    EXPECT_NEAR(angle(crack.tip() + 0.1 * along + aside), 0, 1e-7);
    EXPECT_NEAR(angle(crack.tip() + 0.1 * along - aside), 0, 1e-7);
    // All around a circle behind the kink the angle is continuous but where it crosses the fracture.
    double before = angle(crack.tip() + 0.6 * along);
    int jumps = 0;
    for (int i = 1; i <= 3600; ++i) {
      const double now = angle(crack.tip() + turned(0.6 * along, i * std::numbers::pi / 1800));
      jumps += std::abs(now - before) > 0.01;
      before = now;
    }
    EXPECT_EQ(jumps, 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinks, KinkedFracture, ::testing::Values(0.3, -0.3, 0.8, -0.8, 1.2, -1.2),
                         [](const auto& info) {
                           return (info.param < 0 ? "right_" : "left_") +
                                  std::to_string(static_cast<int>(std::abs(info.param) * 10 + 0.5));
                         });

// A cell ahead of the end, between its walls, is so obtuse that one of its corners lies behind the end, and its centre
// on the other side. Angles are those of the corners, within half a turn of the direction ahead.
TEST(EndOfFracture, HasAnglesWithinHalfATurnInObtuseCells) {
  const double degree = std::numbers::pi / 180;
  for (const double turn : {0.0, 0.5, 2.0, -2.8})
    for (const double mirror : {1.0, -1.0})
      for (const double disturbed : {1.0, 1 + 1e-9}) {
        const auto at = [&](double radius, double angle) {
          return turned({radius, 0}, turn + mirror * angle * degree * disturbed);
        };
        // The end, the other end of the fracture, and the corners behind the end and ahead of it.
        RawMesh raw;
        raw.nodes = {Point::Zero(), at(1, 180), at(1, 100), at(3, -75)};
        for (Ring cell : {Ring(0, 2, 1), Ring(0, 1, 3), Ring(0, 3, 2)}) {
          if (mirror < 0) cell.turn();
          raw.cells.push_back(cell);
        }
        raw.regions.assign(3, 0);
        raw.region_names = {"rock"};
        raw.side_names = {"outside"};
        for (const auto& ends : {std::array{1, 2}, std::array{2, 3}, std::array{3, 1}})
          raw.boundary_faces.push_back({ends, 0});
        raw.fractures = {{"crack", {1, 0}}};
        const Mesh mesh = build_mesh(raw);
        int end = none;
        for (int node = 0; node < mesh.node_count(); ++node)
          if (mesh.nodes[node].norm() < 1e-12) end = node;
        ASSERT_NE(end, none);
        const EndFrame frame(mesh, end);
        for (int cell = 0; cell < mesh.cell_count(); ++cell)
          for (const int node : mesh.cell_nodes[cell]) {
            if (node == end) continue;
            const Point& x = mesh.nodes[node];
            const double found = frame.polar(x, frame.side_of_cell(mesh, cell)).angle / degree;
            if ((x - at(1, 180)).norm() < 1e-6)
              EXPECT_NEAR(std::abs(found), 180, 1e-6) << turn << " " << mirror;
            else
              EXPECT_NEAR(found, mirror * ((x - at(1, 100)).norm() < 1e-6 ? 100 : -75), 1e-6) << turn << " " << mirror;
          }
      }
}

}  // namespace
}  // namespace sprekk::test
