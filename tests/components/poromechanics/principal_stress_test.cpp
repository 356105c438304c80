#include "components/poromechanics/principal_stress.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sprekk::poromechanics {
namespace {

TEST(PrincipalStress, OfTwoStressesThatAreTurned) {
  // -9 along a direction and 2 across it; the turned tensor is R diag R^T.
  for (int degrees = -90; degrees <= 180; degrees += 15) {
    const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
    const SymmetricTensor stress(-9 * c * c + 2 * s * s, -9 * s * s + 2 * c * c, -11 * c * s);
    const PrincipalStress principal = principal_stress(stress);
    EXPECT_NEAR(principal.most_compressive, -9, 1e-14);
    EXPECT_NEAR(principal.least_compressive, 2, 1e-14);
    EXPECT_NEAR(std::abs(principal.direction.dot(Point(c, s))), 1, 1e-14);
    EXPECT_NEAR(principal.direction.norm(), 1, 1e-15);
    const Point& d = principal.direction;
    EXPECT_GT(std::abs(d.x()) > std::abs(d.y()) - 1e-9 ? d.x() : d.y(), 0);
  }
}

TEST(PrincipalStress, OfSmallDifferencesKeepsItsDigits) {
  // A deviation of 1e-9 of the mean at 30 degrees.
  const double deviation = 1e-9, angle = std::numbers::pi / 6;
  const PrincipalStress principal = principal_stress(
      {1 + deviation * std::cos(2 * angle), 1 - deviation * std::cos(2 * angle), deviation * std::sin(2 * angle)});
  EXPECT_NEAR(principal.least_compressive - principal.most_compressive, 2 * deviation, 1e-15);
  EXPECT_NEAR(principal.direction.dot(Point(std::cos(angle), std::sin(angle))), 0, 1e-6);  // 1e-16 over 1e-9
}

TEST(PrincipalStress, DirectionDoesNotTurnByRoundOff) {
  for (const double round_off : {-1e-16, 0.0, 1e-16}) {
    EXPECT_LT((principal_stress({2, -9, round_off}).direction - Point(0, 1)).norm(), 1e-15);
    EXPECT_LT((principal_stress({-9, 2, round_off}).direction - Point(1, 0)).norm(), 1e-15);
    EXPECT_LT((principal_stress({1 + round_off, 1, 3}).direction - Point(1, -1) / std::sqrt(2.0)).norm(), 1e-15);
  }
}

TEST(PrincipalStress, OfAPressureHasNoDirection) {
  const PrincipalStress principal = principal_stress({-3, -3, 0});
  EXPECT_EQ(principal.most_compressive, -3);
  EXPECT_EQ(principal.least_compressive, -3);
  EXPECT_EQ(principal.direction.norm(), 0);
}

}  // namespace
}  // namespace sprekk::poromechanics
