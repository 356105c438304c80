// What a search for a front learns of its Jacobian from moves whose effects are linear.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "components/fine_fracture/growth/learnt_slopes.hpp"

namespace sprekk::fine_fracture {
namespace {

/// Loads and directions of two tips; directions depend on their own segments alone.
Eigen::MatrixXd truth() {
  Eigen::MatrixXd slopes(4, 4);
  slopes << -0.25, 0.1, -0.1, 0.0,  //
      -0.1, 3.5, 0.0, 0.0,          //
      -0.12, 0.0, -0.3, 0.15,       //
      0.0, 0.0, -0.15, 3.8;
  return slopes;
}

LearntSlopes first_estimate() {
  LearntSlopes slopes;
  slopes.jacobian = Eigen::MatrixXd::Zero(4, 4);
  slopes.jacobian.diagonal() << -0.3, 3.3, -0.3, 3.6;  // off by what their uncertainty allows
  return slopes;
}

void move(LearntSlopes& slopes, const Eigen::Vector4d& moved) { slopes.update(moved, truth() * moved); }

/// Whatever the order of the moves; and what one of them has shown stays when others are learnt from.
TEST(LearntSlopes, AreExactAfterAsManyMovesAsUnknowns) {
  Eigen::Matrix4d moves;
  moves << 0.1, 0.02, 0.05, 0.01, 0.003, -0.004, 0.002, 0.001, 0.09, -0.03, 0.02, 0.04, -0.002, 0.001, 0.003, -0.004;
  moves *= 1e-3;  // squares of moves count as errors
  ASSERT_GT(std::abs(moves.determinant()), 0);
  for (const bool is_reversed : {false, true}) {
    LearntSlopes slopes = first_estimate();
    for (int k = 0; k < 4; ++k) move(slopes, moves.col(is_reversed ? 3 - k : k));
    for (int k = 0; k < 4; ++k)
      EXPECT_LT((slopes.jacobian * moves.col(k) - truth() * moves.col(k)).norm(), 1e-4 * moves.col(k).norm()) << k;
    EXPECT_LT((slopes.jacobian - truth()).norm(), 1e-2);
  }
}

/// Twins that advance and turn alike show nothing of their differences. What an update has missed is put down to the
/// tip itself: the share of the other one is the square of the ratio of the uncertainties, at most 0.05.
TEST(LearntSlopes, OfTwinsAreTheirOwn) {
  LearntSlopes slopes = first_estimate();
  move(slopes, {1e-4, 1e-3, 1e-4, 1e-3});
  move(slopes, {1e-3, 0, 1e-3, 0});
  for (int tip = 0; tip < 2; ++tip) {
    const int other = 1 - tip;
    EXPECT_NEAR(slopes.jacobian(2 * tip + 1, 2 * other + 1), 0, 0.05 * 0.2);
    EXPECT_NEAR(slopes.jacobian(2 * tip + 1, 2 * tip + 1), truth()(2 * tip + 1, 2 * tip + 1), 0.05 * 0.2);
    EXPECT_NEAR(slopes.jacobian(2 * tip + 1, 2 * other), 0, 0.05);
  }
}

TEST(LearntSlopes, FollowAResidualThatChanges) {
  LearntSlopes slopes = first_estimate();
  const Eigen::Vector4d moved(1e-3, 0, 0, 0);
  slopes.update(moved, Eigen::Vector4d(-2e-2, 0, 0, 0));
  EXPECT_NEAR(slopes.jacobian(0, 0), -20, 1e-3);
  slopes.update(-moved, Eigen::Vector4d(3e-4, 0, 0, 0));
  EXPECT_NEAR(slopes.jacobian(0, 0), -0.3, 1e-3);
}

}  // namespace
}  // namespace sprekk::fine_fracture
