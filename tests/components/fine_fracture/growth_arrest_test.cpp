// Where and why growth ends: closed forms of the length of arrest, several tips, limits, what cannot go on.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "components/fine_fracture/growth/grow_tips.hpp"
#include "components/fine_fracture/growth/kink.hpp"

namespace sprekk::fine_fracture {
namespace {

using std::numbers::pi;

double unlimited(int, const TipPath&, const Point&) { return 1e9; }

GrowingTip tip_at(double x, double toughness = 0.7e6) {
  return {.tip = Point(x, 0), .direction = Point(1, 0), .toughness = toughness, .youngs_prime = 4e10, .path = {}};
}

double added_length(const GrowingTip& tip, const TipPath& path) {
  double length = 0;
  Point from = tip.tip;
  for (const Point& to : path.added) {
    length += (to - from).norm();
    from = to;
  }
  return length;
}

/// SIFs of one tip in mode I as a function of the length it has added.
template <typename Function>
TipOutcome grow_one(const GrowthOptions& options, Function k1, const FreeLength& free_length = unlimited) {
  const GrowingTip tip = tip_at(0);
  const auto sifs = [&](int, const std::vector<TipPath>& paths) { return Sifs{k1(added_length(tip, paths[0])), 0}; };
  return grow_tips({tip}, options, sifs, free_length)[0];
}

GrowthOptions options_with(double increment, const std::string& length = "arrest") {
  GrowthOptions options;
  options.increment = increment;
  options.length = length;
  return options;
}

double bisection(const std::function<double(double)>& falling, double low, double high) {
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    (falling(middle) > 0 ? low : high) = middle;
  }
  return low;
}

TEST(Arrest, of_a_crack_opened_by_point_forces) {
  // K_I = P/sqrt(pi l), so l = (P/K_IC)^2/pi for any increments. dl/l = −2 dK/K.
  const double force = 0.5e6, start = 0.02, exact = std::pow(force / 0.7e6, 2) / pi;
  for (const double increment : {0.005, 0.013, 0.05, 0.2, 1.0}) {
    const TipOutcome outcome =
        grow_one(options_with(increment), [&](double added) { return force / std::sqrt(pi * (start + added)); });
    EXPECT_TRUE(outcome.arrested);
    EXPECT_NEAR(start + outcome.length, exact, 2.1 * 1e-2 * exact) << increment;
    EXPECT_NEAR(equivalent_sif(outcome.end), 0.7e6, 1e-2 * 0.7e6);
    EXPECT_LE(outcome.evaluations, 1 + std::ceil((exact - start) / increment) + 5) << increment;
    EXPECT_EQ(outcome.reason, "K_eq has come down to the toughness");
  }
}

TEST(Arrest, is_found_sooner_after_another_one) {
  // As above, but the force rises by 3 % again and again. The warm start of the last increment helps, one of another
  // place misleads the search, and the length found is the same.
  GrowthOptions options = options_with(0.05);
  GrowingTip knowing = tip_at(0.02), forgetful = knowing, misled = knowing;
  long with = 0, without = 0;
  for (int rise = 1; rise <= 10; ++rise) {
    const double force = 0.7e6 * std::sqrt(pi * 0.02) * std::pow(1.03, rise), exact = std::pow(force / 0.7e6, 2) / pi;
    const auto grow = [&](GrowingTip& tip) {
      const auto sifs = [&](int, const std::vector<TipPath>& paths) {
        return Sifs{force / std::sqrt(pi * (0.02 + added_length(tip, paths[0]))), 0};
      };
      const TipOutcome outcome = grow_tips({tip}, options, sifs, unlimited)[0];
      EXPECT_TRUE(outcome.arrested);
      EXPECT_NEAR(0.02 + added_length(tip, outcome.path), exact, 2.1 * 1e-2 * exact) << rise;
      tip.path = outcome.path;
      if (outcome.increments > 0) tip.warm_start = outcome.warm_start;
      return outcome.evaluations - 1;  // without that of the start
    };
    with += grow(knowing);
    forgetful.warm_start = {};
    without += grow(forgetful);
    // 10 times and a tenth of what is true here, 25 to 15 per m.
    misled.warm_start = {1, rise % 2 == 0 ? 200.0 : 2.0};
    grow(misled);
  }
  EXPECT_LE(with, 20);
  EXPECT_GE(without, 30);
}

TEST(Arrest, of_wings_of_a_slipping_fracture_under_confinement) {
  // Wings of length l of a fracture of half-length c, effective shear tau, pressed together by sigma_3 (Horii and
  // Nemat-Nasser 1986): K_I = 2 c tau cos(45 degrees)/sqrt(pi (l + 0.27 c)) − sigma_3 sqrt(pi l/2).
  const double c = 0.1;
  for (const double confinement : {0.0, 2e6, 8e6})
    for (const double tolerance : {1e-2, 1e-4}) {
      const auto k1 = [&](double l) {
        return std::sqrt(2.0) * c * 6e6 / std::sqrt(pi * (l + 0.27 * c)) - confinement * std::sqrt(pi * l / 2);
      };
      const double exact = bisection([&](double l) { return k1(l) - 0.7e6; }, 0, 10);
      const double sensitivity = 0.7e6 / std::abs((k1(1.001 * exact) - k1(0.999 * exact)) / 2e-3);  // (dl/l)/(dK/K)
      for (const double increment : {0.004, 0.03, 0.3}) {
        GrowthOptions options = options_with(increment);
        options.arrest_tolerance = tolerance;
        options.at_most = 1000;
        options.smallest = 1e-5;
        const TipOutcome outcome = grow_one(options, k1);
        EXPECT_TRUE(outcome.arrested);
        EXPECT_NEAR(outcome.length, exact, 1.1 * tolerance * sensitivity * exact) << confinement << " " << increment;
        EXPECT_LE(outcome.evaluations, 1 + std::ceil(exact / increment) + (tolerance < 1e-3 ? 6 : 4));
      }
    }
}

TEST(Arrest, turns_and_stops_at_once) {
  // A tip in shear: kinked SIFs fall with the length while T-stress turns the increment. Both conditions hold at its
  // end, and the direction is then independent of the length tried first.
  const Sifs start{0.1e6, 0.8e6, -4e6};
  const auto sifs = [&](int, const std::vector<TipPath>& paths) {
    if (paths[0].added.empty()) return start;
    const Point& end = paths[0].added.back();
    const double length = end.norm();
    Sifs sifs = after_kink(start, 0.97 * std::atan2(end[1], end[0]), length);
    sifs.k1 /= std::sqrt(1 + length / 0.01);
    sifs.k2 /= std::sqrt(1 + length / 0.01);
    return sifs;
  };
  std::vector<Point> ends;
  for (const double increment : {0.02, 0.05}) {
    GrowthOptions options = options_with(increment);
    options.arrest_tolerance = options.direction_tolerance = 1e-4;
    const TipOutcome outcome = grow_tips({tip_at(0)}, options, sifs, unlimited)[0];
    EXPECT_TRUE(outcome.notes.empty());
    ASSERT_EQ(outcome.increments, 1);
    EXPECT_NEAR(equivalent_sif(outcome.end), 0.7e6, 1e-4 * 0.7e6);
    EXPECT_LE(std::abs(outcome.end.k2), 1e-4 * outcome.end.k1);
    ends.push_back(outcome.path.added[0]);
  }
  EXPECT_LT((ends[0] - ends[1]).norm(), 1e-3 * ends[0].norm());
}

// Tension along the tip would turn a whole increment away from where K_II vanishes, and K rises with long ones. A tip
// that is hardly above its toughness ends at the first length at which K has come down to it, in both senses of shear.
TEST(Arrest, is_near_where_tension_turns_long_increments_away) {
  for (const double sense : {1.0, -1.0}) {
    const Sifs start{0.02e6, sense * 0.62e6, 3.5e6};
    const auto change = [](double length) { return 1 - std::sqrt(length / 4.4e-3) + std::pow(length / 0.004, 2); };
    const auto sifs = [&](int, const std::vector<TipPath>& paths) {
      if (paths[0].added.empty()) return start;
      const Point& end = paths[0].added.back();
      Sifs found = after_kink(start, std::atan2(end[1], end[0]), end.norm());
      found.k1 *= change(end.norm());
      found.k2 *= change(end.norm());
      return found;
    };
    GrowthOptions options = options_with(0.01);
    options.smallest = 1e-6;
    const GrowingTip tip = tip_at(0, 0.985 * equivalent_sif(start));
    const TipOutcome outcome = grow_tips({tip}, options, sifs, unlimited)[0];
    EXPECT_TRUE(outcome.arrested) << outcome.reason;
    EXPECT_NEAR(equivalent_sif(outcome.end) / tip.toughness, 1, 1e-2);
    EXPECT_LE(std::abs(outcome.end.k2), options.direction_tolerance * outcome.end.k1);
    EXPECT_LT(outcome.length, 0.8e-3);
    EXPECT_GT(outcome.length, 0.002e-3);
  }
}

// A tip that meets the shadow of another fracture: K jumps, and neither of its sides has the toughness.
TEST(Arrest, that_does_not_exist_ends_the_search_too) {
  const GrowingTip tip = tip_at(0);
  for (const double k1_beyond : {-1457.0, -5e5, 1e3}) {
    int evaluations = 0;
    double jump = 0;  // where the search looks second: it is open there, and closed wherever else it looks
    const auto sifs = [&](int, const std::vector<TipPath>& paths) {
      if (++evaluations > 1000) throw std::runtime_error("the search does not end");
      if (evaluations == 3) jump = added_length(tip, paths[0]);
      return evaluations == 1 || evaluations == 3 ? Sifs{9e5, -1e5} : Sifs{k1_beyond, 4.97e5};
    };
    const TipOutcome outcome = grow_tips({tip}, options_with(0.01), sifs, unlimited)[0];
    EXPECT_LE(outcome.length, jump * (1 + 1e-12)) << k1_beyond;
    EXPECT_FALSE(outcome.notes.empty()) << k1_beyond;
  }
}

TEST(FixedIncrements, go_on_until_below_the_toughness) {
  const TipOutcome outcome =
      grow_one(options_with(0.02, "fixed"), [](double added) { return 0.5e6 / std::sqrt(pi * (0.02 + added)); });
  // l = 0.1624 m at arrest: the eighth increment of 0.02 m is the first to pass it.
  EXPECT_EQ(outcome.increments, 8);
  EXPECT_EQ(outcome.evaluations, 9);
  EXPECT_TRUE(outcome.arrested);
  EXPECT_LT(equivalent_sif(outcome.end), 0.7e6);
}

TEST(GrowTips, three_tips_share_the_increment_by_equation_13) {
  const double k[] = {1.0e6, 0.8e6, 0.75e6};
  std::vector<GrowingTip> tips = {tip_at(0), tip_at(1), tip_at(2)};
  tips[2].youngs_prime = 2e10;
  const auto sifs = [&](int i, const std::vector<TipPath>& paths) {
    return Sifs{paths[i].added.empty() ? k[i] : 0.1e6, 0};
  };
  const std::vector<TipOutcome> outcomes = grow_tips(tips, options_with(0.03, "fixed"), sifs, unlimited);
  // G = K^2/E': 25, 16 and 28.125 J/m^2.
  EXPECT_NEAR(outcomes[0].length, 0.03 * std::pow(25 / 28.125, 0.35), 1e-15);
  EXPECT_NEAR(outcomes[1].length, 0.03 * std::pow(16 / 28.125, 0.35), 1e-15);
  EXPECT_NEAR(outcomes[2].length, 0.03, 1e-15);
}

TEST(GrowTips, only_tips_above_the_toughness_grow) {
  const std::vector<GrowingTip> tips = {tip_at(0), tip_at(1, 2e6)};
  const auto sifs = [&](int i, const std::vector<TipPath>& paths) {
    return Sifs{paths[i].added.empty() ? 1e6 : 0.1e6, 0};
  };
  const std::vector<TipOutcome> outcomes = grow_tips(tips, options_with(0.03, "fixed"), sifs, unlimited);
  EXPECT_EQ(outcomes[0].length, 0.03);
  EXPECT_TRUE(outcomes[1].path.added.empty());
  EXPECT_TRUE(outcomes[1].arrested);
  EXPECT_EQ(outcomes[1].reason, "K_eq does not exceed the toughness");
}

TEST(GrowTips, without_growth_one_evaluation_is_all) {
  const TipOutcome outcome = grow_one(options_with(0.03), [](double) { return 0.7e6; });
  EXPECT_EQ(outcome.evaluations, 1);
  EXPECT_EQ(outcome.increments, 0);
  EXPECT_TRUE(outcome.arrested);
}

TEST(GrowTips, a_tip_at_rest_is_woken_by_its_neighbour) {
  const std::vector<GrowingTip> tips = {tip_at(0), tip_at(1)};
  // The second tip's load rises with what the first one adds.
  const auto sifs = [&](int i, const std::vector<TipPath>& paths) {
    const double own = added_length(tips[i], paths[i]), other = added_length(tips[1 - i], paths[1 - i]);
    return Sifs{i == 0 ? 1e6 - 10e6 * own : 0.5e6 + 20e6 * other - 10e6 * own, 0};
  };
  const std::vector<TipOutcome> outcomes = grow_tips(tips, options_with(0.01), sifs, unlimited);
  // 1 − 10 a = 0.7; 0.5 + 20 a − 10 b = 0.7.
  EXPECT_NEAR(outcomes[0].length, 0.03, 0.0007);
  EXPECT_NEAR(outcomes[1].length, 2 * outcomes[0].length - 0.02, 0.0007);
  for (const TipOutcome& outcome : outcomes) EXPECT_TRUE(outcome.arrested);
}

TEST(GrowTips, tips_that_do_not_interact_are_not_evaluated_for_each_other) {
  const std::vector<GrowingTip> tips = {tip_at(0), tip_at(1)};
  const auto sifs = [&](int i, const std::vector<TipPath>& paths) {
    return Sifs{i == 0 ? 0.5e6 / std::sqrt(pi * (0.02 + added_length(tips[0], paths[0]))) : 0.1e6, 0};
  };
  const auto apart = [](int, int) { return false; };
  const std::vector<TipOutcome> alone = grow_tips(tips, options_with(0.02), sifs, unlimited, apart);
  EXPECT_EQ(alone[1].evaluations, 1);
  const std::vector<TipOutcome> all = grow_tips(tips, options_with(0.02), sifs, unlimited);
  EXPECT_GT(all[1].evaluations, 1);
  EXPECT_EQ(alone[0].path.added.back(), all[0].path.added.back());
}

TEST(GrowTips, unstable_growth_ends_at_the_limits) {
  const auto rising = [](double added) { return 0.8e6 * std::sqrt(1 + added); };
  GrowthOptions options = options_with(0.02);
  options.at_most = 7;
  const TipOutcome by_count = grow_one(options, rising);
  EXPECT_EQ(by_count.increments, 7);
  EXPECT_FALSE(by_count.arrested);
  EXPECT_NE(by_count.reason.find("largest number of increments, 7"), std::string::npos);
  options.longest = 0.05;
  const TipOutcome by_length = grow_one(options, rising);
  EXPECT_NEAR(by_length.length, 0.05, 1e-15);
  EXPECT_FALSE(by_length.arrested);
  EXPECT_EQ(by_length.reason, "it has grown by the largest length, 50 mm");
}

TEST(GrowTips, stop_where_the_way_is_not_free) {
  const auto wall = [](int, const TipPath& path, const Point&) {
    return 0.05 - (path.added.empty() ? 0 : path.added.back()[0]);
  };
  const TipOutcome outcome = grow_one(
      options_with(0.02), [](double) { return 1e6; }, wall);
  EXPECT_NEAR(outcome.length, 0.05, 1e-15);
  EXPECT_FALSE(outcome.arrested);
  EXPECT_EQ(outcome.reason, "it has no free length ahead");
  const TipOutcome at_once = grow_one(
      options_with(0.02), [](double) { return 1e6; }, [](int, const TipPath&, const Point&) { return 0.0; });
  EXPECT_TRUE(at_once.path.added.empty());
  EXPECT_EQ(at_once.evaluations, 1);
  EXPECT_EQ(at_once.reason, "it has no free length ahead");
}

// The exact length is a half or three halves of the shortest increment.
TEST(GrowTips, growth_shorter_than_the_shortest_increment_waits) {
  for (const double part : {0.5, 1.5}) {
    GrowthOptions options = options_with(0.02);
    options.arrest_tolerance = 1e-4;
    const double exact = part * options.smallest_length();
    const auto k_eq = [&](double added) { return 0.7e6 * (1.0199 - 0.0199 * added / exact); };
    const TipOutcome outcome = grow_one(options, k_eq);
    EXPECT_TRUE(outcome.arrested);
    EXPECT_NEAR(outcome.length, part < 1 ? 0 : exact, 0.01 * exact);
    if (part < 1) {
      EXPECT_EQ(outcome.reason, "it would grow by less than the shortest increment");
    }
  }
}

TEST(GrowTips, goes_on_from_a_path_and_keeps_it) {
  GrowingTip tip = tip_at(0);
  tip.path.added = {Point(0.01, 0), Point(0.01, 0.02)};
  const auto sifs = [](int, const std::vector<TipPath>& paths) {
    return Sifs{paths[0].added.size() > 2 ? 0.1e6 : 1e6, 0};
  };
  const TipOutcome outcome = grow_tips({tip}, options_with(0.03, "fixed"), sifs, unlimited)[0];
  ASSERT_EQ(outcome.path.added.size(), 3u);
  EXPECT_EQ(outcome.path.added[1], tip.path.added[1]);
  EXPECT_LT((outcome.path.added[2] - Point(0.01, 0.05)).norm(), 1e-15);  // straight on from its last segment
  EXPECT_NEAR(outcome.length, 0.03, 1e-15);
}

TEST(GrowTips, numbers_that_are_not_finite_stop_the_tip_where_it_was) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const TipOutcome outcome = grow_one(options_with(0.02), [&](double added) { return added > 0.03 ? nan : 1e6; });
  EXPECT_EQ(outcome.increments, 1);
  EXPECT_EQ(outcome.path.added.size(), 1u);
  EXPECT_FALSE(outcome.arrested);
  EXPECT_EQ(outcome.end.k1, 1e6);
  EXPECT_EQ(outcome.reason, "its stress intensity factors are not finite");
}

TEST(GrowTips, without_tips_nothing_happens) {
  const auto sifs = [](int, const std::vector<TipPath>&) { return Sifs{}; };
  EXPECT_TRUE(grow_tips({}, options_with(0.02), sifs, unlimited).empty());
}

}  // namespace
}  // namespace sprekk::fine_fracture
