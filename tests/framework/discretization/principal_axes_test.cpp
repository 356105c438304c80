#include "framework/discretization/principal_axes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sprekk::test {
namespace {

constexpr double round_off = 1e-13;

TEST(PrincipalAxes, OfATurnedTensor) {
  const double angle = 0.7;
  Tensor turn;
  turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  const Tensor tensor = turn * Point(-3, 2).asDiagonal() * turn.transpose();
  const PrincipalAxes found = principal_axes(tensor);
  EXPECT_NEAR(found.values[0], -3, round_off);
  EXPECT_NEAR(found.values[1], 2, round_off);
  for (int k = 0; k < 2; ++k) EXPECT_NEAR(std::abs(found.axes.col(k).dot(turn.col(k))), 1, round_off);
}

}  // namespace
}  // namespace sprekk::test
