// Growth that is not stable: cracks whose stress intensity factors are known in closed form, at one time.
#include "components/fine_fracture/growth/jump.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace sprekk::fine_fracture {
namespace {

constexpr double start = 0.05, increment = 0.01, longest = 0.015;  // m
constexpr double toughness = 7e5;                                  // Pa sqrt(m)

/// One straight crack along a line at this angle; its load is a function of its half-length.
struct Crack {
  std::function<double(double)> load;
  double angle = 0.4;

  FrontTip tip() const {
    FrontTip tip;
    tip.covered = 0.008;
    tip.angle = angle;
    tip.toughness = toughness;
    tip.longest = tip.covered + longest;
    return tip;
  }
  double half_length(double segment) const { return start + segment - tip().covered; }
  std::vector<FrontState> states(double segment, double direction) const {
    FrontState state;
    state.load = load(half_length(segment));
    const double k = toughness * state.load, wrong = direction - angle;
    state.sifs = {k * std::cos(0.7 * wrong), k * std::sin(0.7 * wrong), -1e6};
    return {state};
  }
  FrontOptions options() const {
    FrontOptions options;
    options.increment = increment;
    options.shortest = 1e-4;
    return options;
  }
  Front front() const {
    Front front({tip()}, states(tip().covered, angle), options(), 36);
    while (front.verdict() == Front::Verdict::again) front.learn(states(front.length(0), front.angle(0)));
    return front;
  }
  FrontJump jump() const {
    FrontJump jump({tip()}, states(tip().covered, angle), options());
    for (int k = 0; k < 30 && jump.verdict() == Front::Verdict::again; ++k)
      jump.learn(states(jump.length(0), jump.angle(0)));
    return jump;
  }
};

/// K = p sqrt(pi a) under a uniform pressure: above the toughness it grows without end.
TEST(FrontJump, ACrackUnderAPrescribedPressureIsUnstable) {
  const Crack crack{[](double a) { return 1.01 * std::sqrt(a / start); }};
  EXPECT_NE(crack.front().verdict(), Front::Verdict::found);
  const FrontJump jump = crack.jump();
  EXPECT_EQ(jump.verdict(), Front::Verdict::too_far);
  EXPECT_NEAR(jump.length(0), 0.008 + longest, 1e-12);
  EXPECT_TRUE(jump.record(0).is_unstable);
  EXPECT_NEAR(jump.record(0).advance, longest, 1e-12);
  EXPECT_NEAR(jump.record(0).largest_load, crack.load(start + longest), 1e-12);
  // The integral of (K/K_IC)^2 - 1 is one of a linear function.
  const double square = 1.01 * 1.01, last = start + longest;
  EXPECT_NEAR(jump.record(0).surplus, square * (last * last - start * start) / (2 * start) - longest, 1e-12);
}

/// K = V E'/(2 sqrt(pi) a^1.5) at a fixed volume V: it grows to a = (V E'/(2 sqrt(pi) K_IC))^(2/3), and rests.
TEST(FrontJump, ACrackWithAFixedVolumeIsStable) {
  const Crack crack{[](double a) { return 1.2 * std::pow(start / a, 1.5); }};
  const double rest = start * std::pow(1.2, 2.0 / 3);
  const Front front = crack.front();
  ASSERT_EQ(front.verdict(), Front::Verdict::found);
  EXPECT_NEAR(crack.half_length(front.length(0)), rest, 1e-8);
  const FrontJump jump = crack.jump();
  ASSERT_EQ(jump.verdict(), Front::Verdict::found);
  EXPECT_FALSE(jump.record(0).is_unstable);
  EXPECT_FALSE(jump.drop().has_value());
  EXPECT_NEAR(crack.half_length(jump.length(0)), rest, 1e-3 * rest);
  // G/G_c = 1.44 (start/a)^3; trapezoids over parts of a quarter of an increment.
  const double surplus = 0.72 * start * (1 - std::pow(start / rest, 2)) - (rest - start);
  EXPECT_NEAR(jump.record(0).surplus, surplus, 0.05 * surplus);
}

/// Through a weak layer: the load rises over 6 mm, and falls behind.
TEST(FrontJump, ComesToRestBehindAWeakLayer) {
  const double top = start + 0.006, rise = 0.1, fall = 40;
  const Crack crack{[=](double a) {
    return std::exp(a < top ? 0.001 + rise * (a - start) / 0.006 : 0.001 + rise - fall * (a - top));
  }};
  const FrontJump jump = crack.jump();
  ASSERT_EQ(jump.verdict(), Front::Verdict::found);
  EXPECT_TRUE(jump.record(0).is_unstable);
  EXPECT_NEAR(crack.half_length(jump.length(0)), top + (0.001 + rise) / fall, 1e-3 / fall);
  EXPECT_NEAR(jump.angle(0), 0.4, 1e-12);
}

/// At the border of a tougher layer the load drops across the toughness: the jump ends behind it by at most 1e-4
/// increments, wherever between two trials the border lies, however far the load drops, and whether it rises or falls
/// on the way.
TEST(FrontJump, ComesToRestBehindABorder) {
  for (const double rate : {-2.0, 0.5, 15.0})
    for (const double behind_it : {0.98, 0.81, 0.2})
      for (const double border : {0.0004, 0.0011, 0.00249, 0.0051, 0.00742, 0.0099}) {
        const Crack crack{
            [=](double a) { return a - start > border ? behind_it : std::exp(0.05 + rate * (a - start)); }};
        int trials = 0;
        FrontJump jump({crack.tip()}, crack.states(0.008, 0.4), crack.options());
        for (; trials < 30 && jump.verdict() == Front::Verdict::again; ++trials)
          jump.learn(crack.states(jump.length(0), jump.angle(0)));
        SCOPED_TRACE(testing::Message() << "rate " << rate << ", behind it " << behind_it << ", border " << border);
        ASSERT_EQ(jump.verdict(), Front::Verdict::found);
        const double behind = crack.half_length(jump.length(0)) - start - border;
        EXPECT_GT(behind, 0);
        EXPECT_LE(behind, 1e-4 * increment);
        EXPECT_LE(trials, 20);
        ASSERT_TRUE(jump.drop().has_value());
        EXPECT_NEAR(jump.drop()->before, crack.load(start + (1 - 1e-9) * border), 0.002);
        EXPECT_DOUBLE_EQ(jump.drop()->behind, behind_it);
      }
}

/// Two tips in mirrored directions that share their fluid stay mirrored.
TEST(FrontJump, EqualTipsStayEqual) {
  const Crack one{{}, 0.4}, other{{}, -0.4};
  const auto states = [&](const FrontJump* jump) {
    std::vector<FrontState> states(2);
    const double added = jump ? jump->length(0) + jump->length(1) - 0.016 : 0;
    for (int i = 0; i < 2; ++i) {
      const double wrong = jump ? jump->angle(i) - (i == 0 ? 0.5 : -0.5) : (i == 0 ? -0.1 : 0.1);
      states[i].load = std::exp(0.3 - 20 * added);
      const double k = toughness * states[i].load;
      states[i].sifs = {k * std::cos(0.7 * wrong), k * std::sin(0.7 * wrong), -1e6};
    }
    return states;
  };
  FrontJump jump({one.tip(), other.tip()}, states(nullptr), one.options());
  for (int k = 0; k < 30 && jump.verdict() == Front::Verdict::again; ++k) jump.learn(states(&jump));
  ASSERT_EQ(jump.verdict(), Front::Verdict::found);
  EXPECT_DOUBLE_EQ(jump.length(0), jump.length(1));
  EXPECT_DOUBLE_EQ(jump.angle(0), -jump.angle(1));
  EXPECT_NEAR(jump.length(0) - 0.008, 0.3 / 40, 1e-3 / 20);
  EXPECT_NEAR(jump.angle(0), 0.5, 0.02);
}

/// A tip whose path the mesh cannot take any more rests where it was in the last trial that was solved, and at the
/// start of the step if there was none. The jump of the other one ends at its toughness, although the first is above
/// its own.
TEST(FrontJump, AStoppedTipRestsWhereItWasSolved) {
  const Crack one{{}, 0.4}, other{{}, -0.4};
  const auto states = [&](double length) {
    std::vector<FrontState> states(2);
    states[0].load = 1.3;
    states[1].load = std::exp(0.1 - 40 * (length - 0.008));
    for (FrontState& state : states) state.sifs = {toughness * state.load, 0, -1e6};
    return states;
  };
  for (const int solved : {0, 1}) {
    FrontJump jump({one.tip(), other.tip()}, states(0.008), one.options());
    double last = 0.008;
    for (int k = 0; k < solved; ++k) {
      last = jump.length(0);
      jump.learn(states(jump.length(1)));
    }
    ASSERT_EQ(jump.verdict(), Front::Verdict::again);
    jump.stop(0);
    EXPECT_DOUBLE_EQ(jump.length(0), last);
    EXPECT_EQ(jump.is_laid(0), solved > 0);
    for (int k = 0; k < 30 && jump.verdict() == Front::Verdict::again; ++k) jump.learn(states(jump.length(1)));
    ASSERT_EQ(jump.verdict(), Front::Verdict::found);
    EXPECT_DOUBLE_EQ(jump.length(0), last);
    EXPECT_NEAR(jump.length(1) - 0.008, 0.1 / 40, 1e-3 / 40);
    EXPECT_NEAR(jump.record(0).advance, last - 0.008, 1e-15);
  }
}

/// A trial that cannot be solved is made shorter, until there is no shorter one.
TEST(FrontJump, RetreatsFromWhatCannotBeSolved) {
  const Crack crack{[](double a) { return 1.01 * std::sqrt(a / start); }};
  FrontJump jump({crack.tip()}, crack.states(0.008, 0.4), crack.options());
  double last = jump.length(0);
  int retreats = 0;
  for (; jump.retreat(); ++retreats) {
    EXPECT_LT(jump.length(0), last);
    last = jump.length(0);
  }
  EXPECT_GT(retreats, 2);
  EXPECT_GT(last, 0.008);
}

}  // namespace
}  // namespace sprekk::fine_fracture
