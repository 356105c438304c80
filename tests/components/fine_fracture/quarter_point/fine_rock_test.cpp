// Rock whose stiffness differs from place to place: the crack in a plate, with a stress offset that makes up for what
// the other rock carries less or more, (C - C(x)) eps of the exact strain. Then the exact field solves, and factors are
// known.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/components/fine_fracture/quarter_point/cases.hpp"

namespace sprekk::test {
namespace {

Elasticity times(const Elasticity& rock, double factor) { return {factor * rock.lambda, factor * rock.shear}; }

/// The largest error of both tips where the rock is `factor` times as stiff in part of the box.
double error_with(double factor, const std::function<bool(const Point&)>& is_other) {
  const Griffith exact = paper_crack(1e6, 0.7e6, -3e6);
  const Elasticity other = times(exact.rock, factor), less = times(exact.rock, 1 - factor);
  const FineRock rock([&](const Point& x) { return is_other(x) ? other : exact.rock; }, 1);
  FineLoads loads = exact_outline(exact);
  loads.stress_offset = at_each_place([&](const Point& x) -> Eigen::Vector3d {
    if (!is_other(x)) return Eigen::Vector3d::Zero();
    const Tensor offset = less.stress(exact.rock.strain(exact.stress(x)));
    return {offset(0, 0), offset(1, 1), offset(0, 1)};
  });
  return worst_error(FineModel(paper_box(), paper_mesh(), rock).solve(loads), exact.K());
}

struct Border {
  const char* name;
  std::function<bool(const Point&)> is_behind;
};

/// Tips are at +-50 mm on the x axis, with rosettes of 17 mm; the domain of the integral reaches up to 75 mm.
const std::vector<Border> borders = {
    {"above the crack", [](const Point& x) { return x.y() > 0.03; }},
    {"below the crack", [](const Point& x) { return x.y() < -0.03; }},
    {"ahead of the last tip", [](const Point& x) { return x.x() > 0.075; }},
    {"ahead of the first tip", [](const Point& x) { return x.x() < -0.075; }},
    {"inclined", [](const Point& x) { return x.x() + x.y() > 0.09; }},
    {"far away", [](const Point& x) { return x.y() > 0.15; }},
};

TEST(FineRock, FactorsAreThoseOfTheCrackWhereverTheOtherRockBegins) {
  for (const Border& border : borders)
    for (const double factor : {0.3, 0.7, 3.0})
      EXPECT_LT(error_with(factor, border.is_behind), 1e-3) << border.name << factor;
}

/// K_I of the last tip where the rock is three times as stiff behind a line through (0.05, height) m with an angle.
double load_with_border(double height, double angle, bool tells_border) {
  const Griffith exact = paper_crack(1e6, 0.7e6, -3e6);
  const Elasticity other = times(exact.rock, 3);
  const Point along(std::cos(angle), std::sin(angle)), on_line(0.05, height);
  const auto at = [=](const Point& x) { return cross(along, x - on_line) > 0 ? other : exact.rock; };
  // In several pieces, as a coarse mesh gives them.
  std::vector<FineRock::Border> border;
  for (int piece = -40; piece < 40 && tells_border; ++piece)
    border.push_back({on_line + 0.0237 * piece * along, on_line + 0.0237 * (piece + 1) * along});
  const FineSolution solution =
      FineModel(paper_box(), paper_mesh(), FineRock(at, 1, border)).solve(exact_outline(exact));
  return solution.tips[1].K[0];
}

/// The largest step between neighbouring values, over the mean one.
double largest_step(double height, double angle, bool tells_border) {
  constexpr int count = 24;
  constexpr double shift = 5e-6;  // m
  std::vector<double> steps;
  double last = load_with_border(height, angle, tells_border), sum = 0;
  for (int i = 1; i <= count; ++i) {
    const double load = load_with_border(height + i * shift, angle, tells_border);
    steps.push_back(std::abs(load - last));
    sum += load - last;
    last = load;
  }
  return *std::max_element(steps.begin(), steps.end()) / std::max(std::abs(sum) / count, 1e-12);
}

TEST(FineRock, FactorsAreContinuousWhenABorderMoves) {
  // Outside of the rosette of 17 mm, and through it.
  for (const double height : {0.0301, 0.0453, 0.0081})
    for (const double angle : {0.0, 0.3, -1.1}) {
      const double step = largest_step(height, angle, true), sampled = largest_step(height, angle, false);
      std::printf("at %.4f m, %.1f rad: largest step %.3f of the mean one, without borders %.1f\n", height, angle, step,
                  sampled);
      EXPECT_LT(step, 1.2) << height << ' ' << angle;
    }
}

TEST(FineRock, OneStiffnessByPlaceHasTheBitsOfOneEverywhere) {
  const Griffith exact = paper_crack(1e6, 0.7e6, -3e6);
  const FineRock by_place([&](const Point&) { return exact.rock; }, 1);
  const FineSolution one = FineModel(paper_box(), paper_mesh(), exact.rock).solve(exact_outline(exact)),
                     other = FineModel(paper_box(), paper_mesh(), by_place).solve(exact_outline(exact));
  ASSERT_EQ(one.tips.size(), other.tips.size());
  for (std::size_t i = 0; i < one.tips.size(); ++i) EXPECT_EQ(one.tips[i].K, other.tips[i].K);
  EXPECT_EQ(one.displacement, other.displacement);
}

TEST(FineRock, IsTheSameWhereItsStiffnessIs) {
  const auto at = [](const Point&) { return table_1_rock; };
  EXPECT_EQ(FineRock(table_1_rock), FineRock(table_1_rock));
  EXPECT_FALSE(FineRock(table_1_rock) == FineRock(times(table_1_rock, 2)));
  EXPECT_FALSE(FineRock(table_1_rock) == FineRock(at, 1));
  EXPECT_EQ(FineRock(at, 1), FineRock(at, 1));
  EXPECT_FALSE(FineRock(at, 1) == FineRock(at, 2));
}

}  // namespace
}  // namespace sprekk::test
