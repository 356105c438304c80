// Nodes between two faces that are held: along one direction where both hold as one, wholly at corners.
#include "components/poromechanics/fem/held_directions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "framework/mesh/build_mesh.hpp"
#include "framework/mesh/raw_mesh.hpp"

namespace sprekk::poromechanics {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// A triangle with the corner (0, 0) between two faces, whose normals are turned by `angle` from one to the other, and
/// whose lengths are 1 and `length`. Both faces are of one side, or of two.
Mesh corner(double angle, bool is_one_side, double length = 1, double turn = 0) {
  RawMesh raw;
  const auto at = [&](double along, double direction) {
    return Point(along * std::cos(direction + turn), along * std::sin(direction + turn));
  };
  raw.nodes = {Point(0, 0), at(length, 0), at(1, std::numbers::pi - angle)};
  raw.cells = {Ring(0, 1, 2)};
  raw.regions = {0};
  raw.region_names = {"rock"};
  raw.side_names = {"first", "second", "free"};
  raw.boundary_faces = {{{0, 1}, 0}, {{1, 2}, 2}, {{2, 0}, is_one_side ? 0 : 1}};
  return build_mesh(raw);
}

/// Both sides cannot move along their normals.
Options rollers() {
  Options options;
  for (const char* side : {"first", "second"}) options.boundary[side].displacement_of_face[0] = Data(0);
  return options;
}

int node_at_corner(const Mesh& mesh) {
  for (int node = 0; node < mesh.node_count(); ++node)
    if (mesh.nodes[node].norm() == 0) return node;
  return none;
}

/// How many directions the node at the corner is held along.
int held_at_corner(const Mesh& mesh) {
  const HeldDirections held = held_directions(rollers(), mesh).nodes[node_at_corner(mesh)];
  return held.is_held[0] + held.is_held[1];
}

TEST(HeldDirections, OfACurvedSideAreOneUpToThirtyDegrees) {
  for (const double turn : {0.0, 1.1, 2.9}) {
    EXPECT_EQ(held_at_corner(corner(15 * degree, true, 1, turn)), 1);  // six faces along a quarter of a circle
    EXPECT_EQ(held_at_corner(corner(29 * degree, true, 1, turn)), 1);
    EXPECT_EQ(held_at_corner(corner(31 * degree, true, 1, turn)), 2);
    EXPECT_EQ(held_at_corner(corner(90 * degree, true, 1, turn)), 2);
  }
}

TEST(HeldDirections, OfTwoSidesAreOneIfTheyAreInLine) {
  for (const double turn : {0.0, 1.1, 2.9}) {
    EXPECT_EQ(held_at_corner(corner(1e-9, false, 1, turn)), 1);
    EXPECT_EQ(held_at_corner(corner(0.9e-3, false, 1, turn)), 1);
    EXPECT_EQ(held_at_corner(corner(1.1e-3, false, 1, turn)), 2);
    EXPECT_EQ(held_at_corner(corner(15 * degree, false, 1, turn)), 2);
  }
}

// The mean of the normals, weighted by the lengths of the faces.
TEST(HeldDirections, OfACurvedSideAreTheMean) {
  for (const double turn : {0.0, 1.1, 2.9}) {
    const Mesh mesh = corner(20 * degree, true, 3, turn);
    const HeldDirections held = held_directions(rollers(), mesh).nodes[node_at_corner(mesh)];
    const Point first(std::sin(turn), -std::cos(turn));
    const Point second(std::sin(turn - 20 * degree), -std::cos(turn - 20 * degree));
    const Point mean = (3 * first + second).normalized();
    const int slot = held.is_held[0] ? 0 : 1;
    EXPECT_NEAR(std::abs(held.axes.col(slot).dot(mean)), 1, 1e-14);
  }
}

// Each of two directions keeps its own value: the shares give a displacement with these components along the normals.
TEST(HeldDirections, AtACornerGiveTheDisplacementWithBothComponents) {
  for (const double angle : {0.002, 0.7, 1.5}) {
    const Mesh mesh = corner(angle, false, 2, 0.4);
    const HeldDirections held = held_directions(rollers(), mesh).nodes[node_at_corner(mesh)];
    ASSERT_TRUE(held.is_held[0] && held.is_held[1]);
    const Point wanted(0.3, -1.7);
    for (int k = 0; k < dimension; ++k) {
      double displacement = 0;
      for (const HeldBy& by : held.by[k]) displacement += by.share * mesh.face_normal[by.face].dot(wanted);
      EXPECT_NEAR(displacement, wanted[k], 1e-12 / angle);
    }
  }
}

// A fixed side of length l beside one of length 1 that is pushed along its normal by g: least squares of what is left,
// l |u|^2 + (n.u - g)^2, have u = g/(1 + l) n, in each frame and however the side is fixed.
TEST(HeldDirections, ThatContradictHaveTheLeastSquares) {
  for (const double turn : {0.0, 0.4, 2.9})
    for (const bool is_of_face : {false, true}) {
      const double length = 2, push = 1e-3;
      Options options;
      auto& fixed = options.boundary["first"];
      for (auto& each : is_of_face ? fixed.displacement_of_face : fixed.displacement_along) each = Data(0);
      options.boundary["second"].displacement_of_face[0] = Data(push);
      const Mesh mesh = corner(1.5, false, length, turn);
      const HeldDirections held = held_directions(options, mesh).nodes[node_at_corner(mesh)];
      Point displacement = Point::Zero(), normal = Point::Zero();
      for (int k = 0; k < dimension; ++k)
        for (const HeldBy& by : held.by[k]) {
          if (mesh.face_side[by.face] != 1) continue;
          displacement += held.axes.col(k) * by.share * push;
          normal = mesh.face_normal[by.face];
        }
      EXPECT_LT((displacement - push / (1 + length) * normal).norm(), 1e-15) << turn << " " << is_of_face;
    }
}

}  // namespace
}  // namespace sprekk::poromechanics
