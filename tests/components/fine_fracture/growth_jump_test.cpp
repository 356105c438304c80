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
  double way = longest;  ///< m, that the tip may go

  FrontTip tip() const {
    FrontTip tip;
    tip.covered = 0.008;
    tip.angle = angle;
    tip.toughness = toughness;
    tip.longest = tip.covered + way;
    return tip;
  }
  double half_length(double segment) const { return start + segment - tip().covered; }
  double half_length(const FrontJump& jump) const { return start + jump.advance(0); }
  /// The states on a path that goes on from segment to segment.
  std::vector<FrontState> states(const FrontJump& jump) const {
    return states(tip().covered + jump.advance(0), jump.angle(0));
  }
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
  FrontJump jump(const FrontOptions& options) const {
    // There is something in the way.
    const auto free = [&](int, const Point& from, const Point&) { return tip().covered + way - from.norm(); };
    FrontJump jump({tip()}, states(tip().covered, angle), options, free);
    for (int k = 0; k < 200 && jump.verdict() == Front::Verdict::again; ++k) jump.learn(states(jump));
    return jump;
  }
  FrontJump jump() const { return jump(options()); }
};

/// K = p sqrt(pi a) under a uniform pressure: above the toughness it grows without end.
TEST(FrontJump, ACrackUnderAPrescribedPressureIsUnstable) {
  const Crack crack{[](double a) { return 1.01 * std::sqrt(a / start); }};
  EXPECT_NE(crack.front().verdict(), Front::Verdict::found);
  const FrontJump jump = crack.jump();
  EXPECT_EQ(jump.verdict(), Front::Verdict::too_far);
  EXPECT_NEAR(jump.points(0).back().norm(), 0.008 + longest, 1e-12);
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
  EXPECT_NEAR(crack.half_length(jump), rest, 1e-2 * increment);
  // G/G_c = 1.44 (start/a)^3; trapezoids over parts of a quarter of an increment.
  const double surplus = 0.72 * start * (1 - std::pow(start / rest, 2)) - (rest - start);
  EXPECT_NEAR(jump.record(0).surplus, surplus, 0.05 * surplus);
}

/// Past a limit point: the load at a fixed content of fluid rises, and falls to the toughness twenty increments away.
/// Where the jump ends does not depend on the increment. The path is one of many segments, all of them straight on.
TEST(FrontJump, GoesOnToTheNextEquilibrium) {
  const double equilibrium = 0.2;
  Crack crack{[=](double a) { return std::exp(1e-3 + 0.4 * (a - start) * (equilibrium - (a - start))); }};
  crack.way = 1;
  for (const double part : {0.5, 1.0, 2.0}) {
    FrontOptions options = crack.options();
    options.increment = part * increment;
    const FrontJump jump = crack.jump(options);
    SCOPED_TRACE(part);
    ASSERT_EQ(jump.verdict(), Front::Verdict::found);
    EXPECT_NEAR(jump.advance(0), 0.5 * (equilibrium + std::sqrt(equilibrium * equilibrium + 4e-3 / 0.4)),
                1e-2 * options.increment);
    EXPECT_TRUE(jump.record(0).is_unstable);
    const std::vector<Point> points = jump.points(0);
    EXPECT_GT(points.size(), 8u);
    for (const Point& point : points) EXPECT_NEAR(std::atan2(point[1], point[0]), crack.angle, 1e-12);
    EXPECT_NEAR(points.back().norm(), crack.tip().covered + jump.advance(0), 1e-12);
  }
}

/// The load falls to its least value, 20 mm away, before it rises: up to there a continuous advance would lead, and the
/// jump begins there. Behind it the energy of the closed form is left over.
TEST(FrontJump, BeginsWhereTheLoadIsLeast) {
  const double least = 0.02, equal = 1e-4;
  const auto log_load = [=](double y) { return equal + 40 * y * y - 400 * y * y * y; };
  Crack crack{[=](double a) { return std::exp(log_load(a - start - least)); }};
  crack.way = 1;
  const FrontJump jump = crack.jump();
  ASSERT_EQ(jump.verdict(), Front::Verdict::found);
  const FrontJump::Record& record = jump.record(0);
  EXPECT_TRUE(record.is_unstable);
  EXPECT_NEAR(record.begins, least, 0.25 * increment);
  EXPECT_NEAR(record.advance, least + 0.1, 1e-2 * increment);
  double surplus = 0;
  const double part = 1e-5;
  for (double y = record.begins - least + part / 2; y < 0.1; y += part) surplus += part * std::expm1(2 * log_load(y));
  EXPECT_NEAR(record.surplus, surplus, 0.01 * surplus);
}

/// A bent path keeps its curvature where its segments are divided: the points lie on one circle.
TEST(FrontJump, DividesArcsOnThemselves) {
  const double curvature = 2, along = 0.008;  // 1/m, m
  FrontTip tip;
  tip.covered = along;
  tip.angle = 0.5 * curvature * along;
  tip.toughness = toughness;
  tip.longest = 1;
  tip.is_bent = true;
  tip.start = Point(1, 0);
  const auto states = [&](double load, const Point& from, const Point& to, const Point& ahead) {
    // K_II of the direction of an arc at its end: twice its chord's, less that at its start.
    const Point way = to - from;
    const double end = 2 * std::atan2(way[1], way[0]) - std::atan2(ahead[1], ahead[0]);
    const double wrong = end - std::asin(curvature * to[0]);
    return std::vector<FrontState>{
        {{toughness * load * std::cos(0.5 * wrong), toughness * load * std::sin(0.5 * wrong), 0}, load}};
  };
  FrontOptions options;
  options.increment = increment;
  options.shortest = 1e-4;
  const Point end = along * Point(std::cos(tip.angle), std::sin(tip.angle));
  FrontJump jump({tip}, states(1.1, {0, 0}, end, tip.start), options);
  for (int k = 0; k < 100 && jump.verdict() == Front::Verdict::again; ++k) {
    const std::vector<Point> points = jump.points(0);
    const Point from = points.size() > 1 ? points[points.size() - 2] : Point(0, 0);
    jump.learn(states(1.1 - jump.advance(0), from, points.back(), *jump.start(0)));
  }
  ASSERT_EQ(jump.verdict(), Front::Verdict::found);
  for (const Point& point : jump.points(0)) EXPECT_NEAR((point - Point(0, 1 / curvature)).norm(), 1 / curvature, 2e-4);
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
  EXPECT_NEAR(crack.half_length(jump), top + (0.001 + rise) / fall, 1e-2 * increment);
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
        for (; trials < 30 && jump.verdict() == Front::Verdict::again; ++trials) jump.learn(crack.states(jump));
        SCOPED_TRACE(testing::Message() << "rate " << rate << ", behind it " << behind_it << ", border " << border);
        ASSERT_EQ(jump.verdict(), Front::Verdict::found);
        const double behind = jump.advance(0) - border;
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
  EXPECT_NEAR(jump.advance(0), 0.3 / 40, 1e-2 * increment);
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
    EXPECT_NEAR(jump.advance(1), 0.1 / 40, 1e-2 * increment);
    EXPECT_NEAR(jump.record(0).advance, last - 0.008, 1e-15);
  }
}

/// A trial that cannot be solved is made shorter. When there is no shorter one the jump ends where it was solved last.
TEST(FrontJump, EndsWhereItWasSolvedLast) {
  const Crack crack{[](double a) { return 1.01 * std::sqrt(a / start); }};
  FrontJump jump({crack.tip()}, crack.states(0.008, 0.4), crack.options());
  jump.learn(crack.states(jump));
  jump.learn(crack.states(jump));
  const double solved = 2 * 0.25 * increment;
  EXPECT_GT(jump.advance(0), solved);
  while (!jump.is_left()) ASSERT_TRUE(jump.retreat());
  EXPECT_NEAR(jump.advance(0), solved, 1e-15);
  EXPECT_TRUE(jump.is_left());
  jump.learn(crack.states(jump));
  EXPECT_EQ(jump.verdict(), Front::Verdict::too_far);
  EXPECT_NEAR(jump.record(0).advance, solved, 1e-15);
}

/// Where nothing was solved there is nothing to return to.
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
