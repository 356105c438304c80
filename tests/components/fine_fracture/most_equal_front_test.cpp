// The equations of a front within the error of the mesh: against their definition, and their derivatives.
#include <gtest/gtest.h>

#include <cmath>

#include "components/fine_fracture/growth/most_equal_front.hpp"

namespace sprekk::fine_fracture {
namespace {

using Vector = Eigen::VectorXd;

constexpr double error = 1e-3;

Vector values(std::initializer_list<double> list) {
  Vector vector(static_cast<Eigen::Index>(list.size()));
  Eigen::Index i = 0;
  for (const double value : list) vector[i++] = value;
  return vector;
}

TEST(MostEqualFront, WithoutAnErrorEachLoadVanishes) {
  const Vector loads = values({0.2, -0.1, 3e-4});
  const FrontEquations front = most_equal_front(loads, values({0.1, 0.3, 0}), 0);
  EXPECT_EQ(front.residual, loads);
  EXPECT_TRUE(front.by_load.isIdentity(0));
  EXPECT_TRUE(front.by_advance.isZero(0));
}

TEST(MostEqualFront, OneTipHasItsToughness) {
  EXPECT_EQ(most_equal_front(values({0.2}), values({0.1}), error).residual[0], 0.2);
}

TEST(MostEqualFront, TheEnergyIsBalanced) {
  const Vector loads = values({0.004, -0.0011, 0.0003}), advances = values({0.3, 0.05, 0.2});
  const FrontEquations front = most_equal_front(loads, advances, error);
  EXPECT_NEAR(advances.dot(front.residual), advances.dot(loads), 1e-16);
  EXPECT_NEAR(advances.dot(front.difference), 0, 1e-16);
}

TEST(MostEqualFront, DerivativesAreThose) {
  const Vector loads = values({0.004, -0.0011, 0.0003}), advances = values({0.3, 0.05, 0.2});
  const FrontEquations front = most_equal_front(loads, advances, error);
  const double step = 1e-7;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Vector moved = step * Vector::Unit(3, k);
    const Vector by_load = (most_equal_front(loads + moved, advances, error).residual -
                            most_equal_front(loads - moved, advances, error).residual) /
                           (2 * step);
    EXPECT_LT((by_load - front.by_load.col(k)).norm(), 1e-7) << k;
    // Of the first tip, whose load is more than 2e above the others: pairs that are nearer have a chord.
    const Vector by_advance = (most_equal_front(loads, advances + moved, error).residual -
                               most_equal_front(loads, advances - moved, error).residual) /
                              (2 * step);
    EXPECT_LT(std::abs(by_advance[0] - front.by_advance(0, k)), 1e-8) << k;
  }
}

/// Two tips of which one leads by d: the loads at which this is a front differ by 2e + 2e d/(d + 0.2), and their level
/// follows from the energy.
TEST(MostEqualFront, APairOfUnequalAdvances) {
  for (const double other : {0.0, 0.1, 0.29}) {
    const double ahead = 0.3 - other, apart = 2 * error + 2 * error * ahead / (ahead + 0.2);
    const double first = apart * other / (0.3 + other);
    const FrontEquations front = most_equal_front(values({first, first - apart}), values({0.3, other}), error);
    EXPECT_LT(front.residual.norm(), 1e-15) << other;
  }
}

/// A tip at rest beside one that leads: it starts where the pair above has no advance of its own.
TEST(MostEqualFront, ATipAtRestStartsWhereItsEquationDoes) {
  const Vector loads = values({1e-5}), advances = values({0.3});
  for (const double load : {-0.01, -0.0032, -0.0031, 0.0}) {
    const double beside = load_beside_front(load, loads, advances, error);
    const FrontEquations with = most_equal_front(values({1e-5, load}), values({0.3, 0.0}), error);
    EXPECT_NEAR(beside, with.residual[1], 1e-15) << load;
  }
  EXPECT_LT(load_beside_front(-0.0033, values({0}), advances, error), 0);
  EXPECT_GT(load_beside_front(-0.0031, values({0}), advances, error), 0);
}

TEST(MostEqualFront, AFrontAtRestStartsWithTheMeanOfTipsThatAreAlike) {
  EXPECT_DOUBLE_EQ(load_of_front_at_rest(values({0.001, -0.0005, -0.5}), error), 0.00025);
  EXPECT_DOUBLE_EQ(load_of_front_at_rest(values({0.001, -0.0015}), error), 0.001);
}

}  // namespace
}  // namespace sprekk::fine_fracture
