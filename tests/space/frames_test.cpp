// What is written for any dimension, in three: compiled with SPREKK_DIMENSION=3.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "framework/linear/rigid_rotations.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk {
namespace {

static_assert(dimension == 3 && symmetric_components == 6 && rigid_rotations == 3);

Point random_point(std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  Point point;
  for (double& value : point) value = number(random);
  return point;
}

TEST(Space, RotationsDoNotStrainAndSpanThoseOfEveryAxis) {
  std::mt19937 random(18);
  const Point axis = random_point(random);
  // Coefficients of the three rotations for w × x: of (x, y) the turn about z, of (x, z) against that about y.
  const Point coefficients(axis[2], -axis[1], axis[0]);
  for (int k = 0; k < 20; ++k) {
    const Point a = random_point(random), b = random_point(random);
    EXPECT_NEAR((rotated(a) * coefficients - axis.cross(a)).norm(), 0, 1e-15);
    // The distance between two points does not change.
    EXPECT_NEAR(((rotated(a) - rotated(b)).transpose() * (a - b)).norm(), 0, 1e-15);
  }
}

TEST(Space, AFractureCellTakesVectorsIntoItsFrameAndBack) {
  std::mt19937 random(18);
  FractureCell cell{};
  cell.normal = random_point(random).normalized();
  cell.tangents.col(0) = cell.normal.unitOrthogonal();
  cell.tangents.col(1) = cell.normal.cross(cell.tangents.col(0));
  EXPECT_NEAR((cell.to_local(cell.normal) - Point(1, 0, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((cell.to_local(cell.tangents.col(1)) - Point(0, 0, 1)).norm(), 0, 1e-15);
  for (int k = 0; k < 20; ++k) {
    const Point vector = random_point(random);
    EXPECT_NEAR((cell.to_global(cell.to_local(vector)) - vector).norm(), 0, 1e-15);
    EXPECT_NEAR(cell.to_local(vector).norm(), vector.norm(), 1e-15);
  }
}

}  // namespace
}  // namespace sprekk
