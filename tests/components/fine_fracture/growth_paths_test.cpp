// Directions of growing tips: where explicit ones zigzag and implicit ones do not, large kinks, mirrored problems.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <utility>

#include "components/fine_fracture/growth/grow_tips.hpp"
#include "components/fine_fracture/growth/kink.hpp"
#include "tests/components/fine_fracture/curved_crack.hpp"

namespace sprekk::fine_fracture {
namespace {

constexpr double degree = std::numbers::pi / 180;
const CurvedCrack crack{0.1, 0.7e6 / std::sqrt(std::numbers::pi * 0.1), -10e6};
constexpr double largest_stable = 0.170 * 0.07 * 0.07;  // Delta* = 0.170 (K_I/T)^2, m

double unlimited(int, const TipPath&, const Point&) { return 1e9; }

GrowthOptions whole_increments(const std::string& direction, double increment, int count) {
  GrowthOptions options;
  options.direction = direction;
  options.length = "fixed";
  options.increment = increment;
  options.at_most = count;
  return options;
}

/// The tip of `crack` after a first increment that is wrong by one degree.
GrowingTip misdirected(double increment) {
  GrowingTip tip{.tip = Point(0.1, 0), .direction = Point(1, 0), .toughness = 1e3, .youngs_prime = 4e10, .path = {}};
  tip.path.added.push_back(tip.tip + increment * Point(std::cos(degree), std::sin(degree)));
  return tip;
}

std::vector<double> degrees(const Point& tip, const TipPath& path) {
  std::vector<double> angles;
  Point from = tip;
  for (const Point& to : path.added) {
    angles.push_back(std::atan2(to[1] - from[1], to[0] - from[0]) / degree);
    from = to;
  }
  return angles;
}

TipOutcome grow_misdirected(const std::string& direction, double increment, int count, double t_stress_told = 1) {
  const auto sifs = [&](int, const std::vector<TipPath>& paths) {
    Sifs sifs = crack.sifs(paths[0].added);
    sifs.t_stress *= t_stress_told;
    return sifs;
  };
  return grow_tips({misdirected(increment)}, whole_increments(direction, increment, count), sifs, unlimited)[0];
}

TEST(ExplicitDirection, zigzags_as_published) {
  std::ifstream file(SPREKK_SOURCE_DIR "/tests/components/fine_fracture/reference/zigzag_explicit_MTS.csv");
  std::string line, cell;
  std::getline(file, line);
  int rows = 0;
  for (; std::getline(file, line); ++rows) {
    std::stringstream cells(line);
    std::vector<double> row;
    while (std::getline(cells, cell, ',')) row.push_back(std::stod(cell));
    const TipOutcome outcome = grow_misdirected("explicit", row[0] * largest_stable, 9);
    const std::vector<double> angles = degrees(Point(0.1, 0), outcome.path);
    ASSERT_EQ(angles.size(), 10u);
    for (int step = 1; step <= 9; ++step) {
      // The table is not of first order in the angles; it is followed as long as they are small.
      if (std::abs(row[1 + step]) > 4) break;
      EXPECT_NEAR(angles[step], row[1 + step], 3e-3 + 5e-3 * std::abs(row[1 + step])) << row[0] << ", step " << step;
    }
    EXPECT_EQ(outcome.evaluations, 10);
  }
  EXPECT_EQ(rows, 6);
}

TEST(ExplicitDirection, is_stable_below_the_limit_only) {
  // For a crack so long that its growth does not change K_I: whether the swings become smaller over 60 increments.
  const CurvedCrack long_crack{1000, 0.7e6 / std::sqrt(std::numbers::pi * 1000), -10e6};
  const auto late_over_early = [&](double increment) {
    GrowingTip tip{.tip = Point(1000, 0), .direction = Point(1, 0), .toughness = 1e3, .youngs_prime = 4e10, .path = {}};
    tip.path.added.push_back(tip.tip + increment * Point(std::cos(1e-3 * degree), std::sin(1e-3 * degree)));
    const auto sifs = [&](int, const std::vector<TipPath>& paths) { return long_crack.sifs(paths[0].added); };
    const TipOutcome outcome = grow_tips({tip}, whole_increments("explicit", increment, 60), sifs, unlimited)[0];
    const std::vector<double> angles = degrees(tip.tip, outcome.path);
    return std::abs(angles[60] - angles[59]) / std::abs(angles[30] - angles[29]);
  };
  EXPECT_LT(late_over_early(0.98 * largest_stable), 1);
  EXPECT_GT(late_over_early(1.02 * largest_stable), 1);
}

TEST(ExplicitDirection, relaxation_moves_the_limit) {
  GrowthOptions options = whole_increments("explicit", 2 * largest_stable, 9);
  options.relaxation = 0.5;
  const GrowingTip tip = misdirected(options.increment);
  const auto sifs = [&](int, const std::vector<TipPath>& paths) { return crack.sifs(paths[0].added); };
  const std::vector<double> angles = degrees(tip.tip, grow_tips({tip}, options, sifs, unlimited)[0].path);
  EXPECT_LT(std::abs(angles[9] - angles[8]), std::abs(angles[2] - angles[1]));
}

TEST(ImplicitDirection, does_not_zigzag_with_increments_far_above_the_limit) {
  for (const double ratio : {1.0, 10.0, 30.0, 60.0}) {
    const TipOutcome outcome = grow_misdirected("implicit", ratio * largest_stable, 9);
    const std::vector<double> angles = degrees(Point(0.1, 0), outcome.path);
    ASSERT_EQ(angles.size(), 10u);
    for (int step = 1; step <= 9; ++step) {
      EXPECT_LT(angles[step], 0.05) << ratio << ", step " << step;  // back towards the axis, and no further swing
      EXPECT_GT(angles[step], -0.6) << ratio << ", step " << step;
    }
    EXPECT_LT(std::abs(angles[9]), 0.1) << ratio;
    EXPECT_LE(std::abs(outcome.end.k2), 1e-2 * outcome.end.k1);
    EXPECT_TRUE(outcome.notes.empty());
    EXPECT_LE(outcome.evaluations, 1 + 2 * 9) << ratio;
  }
}

TEST(ImplicitDirection, does_not_need_the_t_stress) {
  const TipOutcome told = grow_misdirected("implicit", 30 * largest_stable, 9);
  const TipOutcome untold = grow_misdirected("implicit", 30 * largest_stable, 9, 0);
  const std::vector<double> a = degrees(Point(0.1, 0), told.path), b = degrees(Point(0.1, 0), untold.path);
  // d(K_II/K_I)/d(angle) is at least 1/2 + 2 sqrt(2/pi) |T| sqrt(s)/K_I: what the tolerance of K_II is worth.
  const double worth =
      1e-2 / (0.5 + 2 * std::sqrt(2 / std::numbers::pi) * 10e6 * std::sqrt(30 * largest_stable) / 0.9e6);
  for (int step = 1; step <= 9; ++step) EXPECT_NEAR(a[step], b[step], 2 * worth / degree) << step;
  EXPECT_LE(untold.evaluations, 1 + 3 * 9);
}

/// Kink of a tip whose SIFs after it are C_ij of Cotterell and Rice (1980), not what the search itself estimates.
Sifs after_kink_of_cotterell_and_rice(const Sifs& sifs, double angle) {
  const double c1 = std::cos(angle / 2), c3 = std::cos(3 * angle / 2), s1 = std::sin(angle / 2),
               s3 = std::sin(3 * angle / 2);
  return {(3 * c1 + c3) / 4 * sifs.k1 - 0.75 * (s1 + s3) * sifs.k2,
          (s1 + s3) / 4 * sifs.k1 + (c1 + 3 * c3) / 4 * sifs.k2};
}

TEST(ImplicitDirection, finds_the_large_kink_of_a_tip_in_shear) {
  for (const double k2 : {1e6, -1e6}) {
    const GrowingTip tip{
        .tip = Point(0, 0), .direction = Point(1, 0), .toughness = 0.7e6, .youngs_prime = 4e10, .path = {}};
    const auto sifs = [&](int, const std::vector<TipPath>& paths) {
      if (paths[0].added.empty()) return Sifs{0, k2};
      return after_kink_of_cotterell_and_rice({0, k2}, std::atan2(paths[0].added[0][1], paths[0].added[0][0]));
    };
    GrowthOptions options = whole_increments("implicit", 0.01, 1);
    options.direction_tolerance = 1e-4;
    const TipOutcome outcome = grow_tips({tip}, options, sifs, unlimited)[0];
    // C_22 = 0 where cos(angle) = 1/3; the tolerance on K_II over dK_II/d(angle).
    EXPECT_NEAR(degrees(tip.tip, outcome.path)[0], -std::copysign(std::acos(1.0 / 3) / degree, k2), 0.02);
    EXPECT_LE(outcome.evaluations, 1 + 4);
  }
}

// K_II/K_I is half the tangent of what the turn is off by, so this is at most twice the tolerance. A looser search
// takes fewer evaluations, and does not happen to be as near as a tighter one.
TEST(ImplicitDirection, is_found_to_its_tolerance) {
  const GrowingTip tip{
      .tip = Point(0, 0), .direction = Point(1, 0), .toughness = 0.7e6, .youngs_prime = 4e10, .path = {}};
  for (const double root : {0.35, -0.35, 0.9, -0.9}) {
    const auto sifs = [&](int, const std::vector<TipPath>& paths) {
      const Point end = paths[0].added.empty() ? Point(1, 0) : paths[0].added.back();
      return Sifs{1e6, 0.5e6 * std::tan(std::atan2(end[1], end[0]) - root)};
    };
    long evaluations = 0;
    for (const auto& [tolerance, tighter] : {std::pair(1e-1, 1e-3), {1e-3, 1e-6}, {1e-8, 0.0}}) {
      GrowthOptions options = whole_increments("implicit", 0.01, 1);
      options.direction_tolerance = tolerance;
      const TipOutcome outcome = grow_tips({tip}, options, sifs, unlimited)[0];
      const double off = std::abs(degrees(tip.tip, outcome.path)[0] * degree - root);
      EXPECT_LE(off, 2 * tolerance) << root;
      EXPECT_GT(off, 2 * tighter) << root << ", " << tolerance;
      EXPECT_GT(outcome.evaluations, evaluations) << root << ", " << tolerance;
      evaluations = outcome.evaluations;
    }
  }
}

TEST(ImplicitDirection, is_not_sought_where_tension_along_the_tip_makes_the_path_itself_unstable) {
  // T > 0: the deviation of the crack grows, steadily and to one side (Cotterell and Rice 1980).
  const CurvedCrack pulled{crack.half_length, crack.opening, -crack.t_stress};
  const auto sifs = [&](int, const std::vector<TipPath>& paths) { return pulled.sifs(paths[0].added); };
  const double increment = 0.5 * largest_stable;
  const GrowingTip tip = misdirected(increment);
  const TipOutcome outcome = grow_tips({tip}, whole_increments("implicit", increment, 9), sifs, unlimited)[0];
  const std::vector<double> angles = degrees(tip.tip, outcome.path);
  for (int step = 2; step <= 9; ++step) {
    EXPECT_GT(angles[step], angles[step - 1]);
    EXPECT_LT(angles[step], 2 * angles[step - 1]);
  }
  EXPECT_EQ(outcome.notes.size(), 9u);
  EXPECT_EQ(outcome.evaluations, 10);
}

TEST(ImplicitDirection, falls_back_to_the_explicit_one_with_a_note) {
  // Shear that no turn removes.
  const GrowingTip tip{
      .tip = Point(0, 0), .direction = Point(1, 0), .toughness = 0.7e6, .youngs_prime = 4e10, .path = {}};
  const auto sifs = [](int, const std::vector<TipPath>&) { return Sifs{1e6, 0.8e6}; };
  const TipOutcome outcome = grow_tips({tip}, whole_increments("implicit", 0.01, 1), sifs, unlimited)[0];
  ASSERT_EQ(outcome.notes.size(), 1u);
  EXPECT_NE(outcome.notes[0].find("maximum tangential stress"), std::string::npos);
  EXPECT_NEAR(degrees(tip.tip, outcome.path)[0] * degree, maximum_tangential_angle({1e6, 0.8e6}), 1e-12);
  EXPECT_LE(outcome.evaluations, 1 + 9);
}

TEST(ImplicitDirection, takes_a_direction_that_is_nearly_symmetric_where_none_is_right) {
  // K_II/K_I is the same in all directions: up to 0.1, ten times what is allowed, the first one that was tried is as
  // good as any.
  const GrowingTip tip{
      .tip = Point(0, 0), .direction = Point(1, 0), .toughness = 0.7e6, .youngs_prime = 4e10, .path = {}};
  for (const double sign : {1.0, -1.0}) {
    for (const auto& [share, is_good] : {std::pair{0.09, true}, {0.11, false}}) {
      const Sifs everywhere{1e6, sign * share * 1e6};
      const auto sifs = [&](int, const std::vector<TipPath>&) { return everywhere; };
      const GrowthOptions options = whole_increments("implicit", 0.01, 1);
      const TipOutcome outcome = grow_tips({tip}, options, sifs, unlimited)[0];
      ASSERT_EQ(outcome.notes.size(), 1u);
      EXPECT_NE(outcome.notes[0].find(is_good ? "best direction" : "maximum tangential stress"), std::string::npos)
          << outcome.notes[0];
      const double expected =
          is_good ? local_symmetry_angle(everywhere, 0.01, options.largest_turn) : maximum_tangential_angle(everywhere);
      EXPECT_NEAR(degrees(tip.tip, outcome.path)[0] * degree, expected, 1e-12) << share;
    }
  }
}

TEST(ImplicitDirection, is_sought_up_to_the_largest_turn_in_so_many_tries) {
  const GrowingTip tip{
      .tip = Point(0, 0), .direction = Point(1, 0), .toughness = 0.7e6, .youngs_prime = 4e10, .path = {}};
  // K_II vanishes where the path has turned by this angle, and K_I is above the toughness everywhere.
  const auto turned_by = [&](double root, const GrowthOptions& options) {
    const auto sifs = [&](int, const std::vector<TipPath>& paths) {
      const Point end = paths[0].added.empty() ? Point(1, 0) : paths[0].added.back();
      return Sifs{1e6, 0.5e6 * std::sin(std::atan2(end[1], end[0]) - root)};
    };
    return grow_tips({tip}, options, sifs, unlimited)[0];
  };
  for (const double sign : {1.0, -1.0}) {
    GrowthOptions options = whole_increments("implicit", 0.01, 1);
    for (const double root : {0.4, 1.39}) {
      const TipOutcome found = turned_by(sign * root, options);
      EXPECT_TRUE(found.notes.empty()) << root;
      EXPECT_NEAR(degrees(tip.tip, found.path)[0] * degree, sign * root, 0.02) << root;
    }
    const TipOutcome beyond = turned_by(sign * 1.6, options);
    EXPECT_FALSE(beyond.notes.empty());
    EXPECT_LE(std::abs(degrees(tip.tip, beyond.path)[0]) * degree, options.largest_turn * (1 + 1e-12));
    options.tries = 2;
    EXPECT_FALSE(turned_by(sign * 1.39, options).notes.empty());
  }
}

TEST(GrowTips, mirrored_problems_have_mirrored_paths) {
  // Two tips that interact: SIFs of a kinked tip with a K_I and a K_II that the distance of the other changes.
  const auto problem = [](double mirror, const std::string& direction) {
    std::vector<GrowingTip> tips(2, {.tip = Point(0, 0),
                                     .direction = Point(0.8, 0.6 * mirror),
                                     .toughness = 0.7e6,
                                     .youngs_prime = 4e10,
                                     .path = {}});
    tips[1].tip = Point(0.3, 0.5 * mirror);
    tips[1].direction = Point(-1, 0);
    const auto end_of = [tips](int i, const std::vector<TipPath>& paths) {
      return paths[i].added.empty() ? tips[i].tip : paths[i].added.back();
    };
    const auto sifs = [=](int i, const std::vector<TipPath>& paths) {
      const Point end = end_of(i, paths), apart = end_of(1 - i, paths) - end;
      const double distance = apart.norm(), grown = (end - tips[i].tip).norm();
      Sifs sifs{0.4e6 / std::sqrt(1 + 20 * grown), mirror * (i == 0 ? 0.9e6 : -0.7e6)};
      sifs.k1 += 0.1e6 * distance;
      Point before = tips[i].tip, ahead = tips[i].direction;
      for (const Point& point : paths[i].added) {
        const Point to = (point - before).normalized();
        const double turn = std::asin(std::clamp(ahead[0] * to[1] - ahead[1] * to[0], -1.0, 1.0));
        sifs = after_kink_of_cotterell_and_rice(sifs, turn);
        before = point;
        ahead = to;
      }
      return sifs;
    };
    GrowthOptions options;
    options.direction = direction;
    options.increment = 0.02;
    options.at_most = 6;
    return grow_tips(tips, options, sifs, unlimited);
  };
  for (const std::string direction : {"implicit", "explicit", "largest_release"}) {
    const std::vector<TipOutcome> up = problem(1, direction), down = problem(-1, direction);
    for (int i = 0; i < 2; ++i) {
      ASSERT_GE(up[i].increments, 2) << direction;
      ASSERT_EQ(up[i].path.added.size(), down[i].path.added.size());
      EXPECT_EQ(up[i].evaluations, down[i].evaluations);
      for (std::size_t k = 0; k < up[i].path.added.size(); ++k) {
        EXPECT_NEAR(up[i].path.added[k][0], down[i].path.added[k][0], 1e-15);
        EXPECT_NEAR(up[i].path.added[k][1], -down[i].path.added[k][1], 1e-15);
      }
    }
  }
}

/// In whatever direction the tip points, pure shear turns it by what the rules say, from there on.
TEST(LargestRelease, is_the_first_direction_in_pure_shear) {
  for (const auto& [direction, kink] :
       std::vector<std::pair<std::string, double>>{{"explicit", -70.53}, {"largest_release", -75.76}})
    for (const double turned : {0.0, 30.0, 123.0}) {
      GrowingTip tip{.tip = Point(0.1, 0.2),
                     .direction = Point(std::cos(turned * degree), std::sin(turned * degree)),
                     .toughness = 1,
                     .youngs_prime = 1,
                     .path = {}};
      const auto sifs = [](int, const std::vector<TipPath>& paths) {
        return paths[0].added.empty() ? Sifs{0, 1} : Sifs{0.5, 0};
      };
      const TipOutcome outcome = grow_tips({tip}, whole_increments(direction, 0.01, 5), sifs, unlimited)[0];
      ASSERT_EQ(outcome.increments, 1);
      EXPECT_NEAR(std::remainder(degrees(tip.tip, outcome.path)[0] - turned - kink, 360), 0, 0.05);
    }
}

}  // namespace
}  // namespace sprekk::fine_fracture
