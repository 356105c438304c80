// The return of a trial traction to the cone of friction, with one and two tangents, against closed forms.
#include "components/contact/return_map.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>

namespace sprekk::contact {
namespace {

template <int n>
using Tangential = Eigen::Matrix<double, n, 1>;

constexpr double friction = 0.5;

template <int n>
TrialTraction<n> trial(double normal, const Tangential<n>& tangential) {
  return {normal, tangential, -friction * std::min(0.0, normal)};
}

/// Trial tractions of which about a third each stick, slip and are open.
class Trials {
 public:
  template <int n>
  TrialTraction<n> next() {
    const double normal = number_(random_) - 0.3;
    Tangential<n> tangential;
    for (double& value : tangential) value = 0.5 * number_(random_);
    return trial<n>(normal, tangential);
  }
  double number() { return number_(random_); }

 private:
  std::mt19937 random_{18};
  std::uniform_real_distribution<double> number_{-1, 1};
};

TEST(ReturnMap, ATrialInsideOfTheConeSticks) {
  const auto t = trial<2>(-10, {3, -3.9});  // |t| = 4.92 < 5
  EXPECT_EQ(t.state(), State::stick);
  const auto returned = return_to_cone<2>(t);
  EXPECT_EQ(returned.tangential, t.tangential);
  EXPECT_EQ(returned.by_trial, Eigen::Matrix2d::Identity());
  EXPECT_EQ(returned.by_bound, Eigen::Vector2d::Zero());
}

TEST(ReturnMap, ATrialOutsideSlipsInItsOwnDirection) {
  const auto t = trial<2>(-10, {6, 8});
  EXPECT_EQ(t.state(), State::slip);
  const auto returned = return_to_cone<2>(t);
  EXPECT_NEAR((returned.tangential - Eigen::Vector2d(3, 4)).norm(), 0, 1e-15);  // 0.5 · 10 along (0.6, 0.8)
  const Eigen::Matrix2d turns{{0.32, -0.24}, {-0.24, 0.18}};                    // 5 / 10 (I − d d^T)
  EXPECT_NEAR((returned.by_trial - turns).norm(), 0, 1e-15);
  EXPECT_NEAR((returned.by_bound - Eigen::Vector2d(0.6, 0.8)).norm(), 0, 1e-15);
}

TEST(ReturnMap, OpenWallsBearNothing) {
  const auto t = trial<2>(1, {6, 8});
  EXPECT_EQ(t.state(), State::open);
  const auto returned = return_to_cone<2>(t);
  EXPECT_EQ(returned.tangential, Eigen::Vector2d::Zero());
  EXPECT_EQ(returned.by_trial, Eigen::Matrix2d::Zero());
  EXPECT_EQ(returned.by_bound, Eigen::Vector2d::Zero());
}

/// Of all tractions in the cone with this normal part it is the nearest: (t − f)·(g − f) <= 0 for each other g.
TEST(ReturnMap, IsTheNearestInTheCone) {
  Trials trials;
  int slips = 0;
  for (int k = 0; k < 300; ++k) {
    const auto t = trials.next<2>();
    if (t.is_open()) continue;
    slips += t.state() == State::slip;
    const Eigen::Vector2d f = return_to_cone<2>(t).tangential;
    EXPECT_LE(f.norm(), t.bound * (1 + 1e-15));
    if (t.state() == State::slip) {
      EXPECT_NEAR(f.norm(), friction * std::abs(t.normal), 1e-15);
    }
    for (int j = 0; j < 16; ++j) {
      const Eigen::Vector2d other = t.bound * Eigen::Vector2d(std::cos(0.4 * j), std::sin(0.4 * j));
      EXPECT_LE((t.tangential - f).dot(other - f), 1e-14);
    }
  }
  EXPECT_GT(slips, 50);
}

template <int n>
void expect_derivatives_of_differences() {
  constexpr double step = 1e-6;
  Trials trials;
  int states[3] = {0, 0, 0};
  for (int k = 0; k < 300; ++k) {
    const auto t = trials.next<n>();
    const double from_cone = std::abs(magnitude<n>(t.tangential) - t.bound);
    if (from_cone < 1e-3 || std::abs(t.normal) < 1e-3) continue;  // differences do not see a kink
    ++states[static_cast<int>(t.state())];
    const auto returned = return_to_cone<n>(t);
    const double tolerance = 1e-5;  // (step / |trial|)^2 and rounding over the step
    for (int c = 0; c < n; ++c) {
      auto up = t, down = t;
      up.tangential[c] += step;
      down.tangential[c] -= step;
      const Tangential<n> slope = (return_to_cone<n>(up).tangential - return_to_cone<n>(down).tangential) / (2 * step);
      EXPECT_NEAR((slope - returned.by_trial.col(c)).norm(), 0, tolerance);
    }
    auto up = t, down = t;
    up.bound += step;
    down.bound -= step;
    const Tangential<n> slope = (return_to_cone<n>(up).tangential - return_to_cone<n>(down).tangential) / (2 * step);
    EXPECT_NEAR((slope - returned.by_bound).norm(), 0, tolerance);
  }
  for (const int count : states) EXPECT_GT(count, 20);
}

TEST(ReturnMap, DerivativesAreThoseOfDifferences) {
  expect_derivatives_of_differences<1>();
  expect_derivatives_of_differences<2>();
}

TEST(ReturnMap, ATurnedFrameGivesTheTurnedAnswer) {
  Trials trials;
  for (int k = 0; k < 200; ++k) {
    const auto t = trials.next<2>();
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(3 * trials.number()).toRotationMatrix();
    auto turned = t;
    turned.tangential = turn * t.tangential;
    const auto here = return_to_cone<2>(t), there = return_to_cone<2>(turned);
    EXPECT_NEAR((there.tangential - turn * here.tangential).norm(), 0, 1e-15);
    EXPECT_NEAR((there.by_trial - turn * here.by_trial * turn.transpose()).norm(), 0, 1e-14);
    EXPECT_NEAR((there.by_bound - turn * here.by_bound).norm(), 0, 1e-15);
  }
}

TEST(ReturnMap, InAPlaneItIsTheScalarMapToTheBit) {
  Trials trials;
  for (int k = 0; k < 1000; ++k) {
    auto t = trials.next<1>();
    if (k % 5 == 0) t.tangential[0] = (k % 2 ? 1 : -1) * t.bound;  // on the cone
    if (k % 7 == 0) t.tangential[0] = k % 2 ? 0.0 : -0.0;
    const double value = t.tangential[0];
    const bool is_open = t.normal > 0, sticks = std::abs(value) <= t.bound;
    const double direction = value > 0 ? 1 : -1;
    const auto returned = return_to_cone<1>(t);
    EXPECT_EQ(returned.tangential[0], is_open ? 0 : sticks ? value : direction * t.bound);
    EXPECT_EQ(returned.by_trial(0, 0), !is_open && sticks ? 1 : 0);
    EXPECT_EQ(returned.by_bound[0], is_open || sticks ? 0 : direction);
  }
}

TEST(ReturnMap, AlongOneTangentSpaceIsAPlane) {
  Trials trials;
  for (int k = 0; k < 200; ++k) {
    const auto plane = trials.next<1>();
    const auto space = trial<2>(plane.normal, {0, plane.tangential[0]});
    const auto expected = return_to_cone<1>(plane);
    const auto returned = return_to_cone<2>(space);
    EXPECT_EQ(space.state(), plane.state());
    EXPECT_EQ(returned.tangential[0], 0);
    EXPECT_NEAR(returned.tangential[1], expected.tangential[0], 1e-15);
    EXPECT_NEAR(returned.by_trial(1, 1), expected.by_trial(0, 0), 1e-15);
    EXPECT_NEAR(returned.by_bound[1], expected.by_bound[0], 1e-15);
  }
}

/// Friction that is bounded by nothing beyond the kink of the gap is continued linearly: the bound may be negative.
TEST(ReturnMap, ANegativeBoundIsContinuedLinearly) {
  TrialTraction<1> t{-1, Tangential<1>(2), -0.5};
  EXPECT_EQ(t.state(), State::slip);
  EXPECT_EQ(return_to_cone<1>(t).tangential[0], -0.5);
  TrialTraction<2> nothing{-1, Tangential<2>(0, 0), -0.5};
  EXPECT_TRUE(return_to_cone<2>(nothing).tangential.allFinite());
  EXPECT_TRUE(return_to_cone<2>(nothing).by_trial.allFinite());
}

}  // namespace
}  // namespace sprekk::contact
