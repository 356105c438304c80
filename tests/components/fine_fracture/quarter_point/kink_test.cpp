// Kinks at the end of a crack in a plate, and cracks with little room.
#include <algorithm>
#include <stdexcept>

#include "tests/components/fine_fracture/quarter_point/cases.hpp"

namespace sprekk::test {
namespace {

/// A crack of half-length 1 whose right end has a kink of the given length and angle (counter-clockwise).
FineGeometry kinked(double length, double angle) {
  const Point end = Point(1, 0) + length * Point(std::cos(angle), std::sin(angle));
  return {rectangle(-4, -4, 4, 4), {{{{-1, 0}, {1, 0}, end}, true, true, {Walls::traction, Walls::traction}}}};
}

Point intensities(const FineGeometry& geometry, const Griffith& exact, double length) {
  const FineMeshOptions options{.tip_size = length / 3, .far_size = 1, .growth = 0.3, .kink_size = length / 30};
  const FineSolution solution = FineModel(geometry, options, exact.rock).solve(exact_outline(exact));
  EXPECT_TRUE(solution.tips.at(1).is_last);
  EXPECT_LE(solution.tips[1].domain_radius, length * (1 + 1e-12));
  return solution.tips[1].K;
}

/// Of an infinitesimal kink: along = normal makes T vanish, so that the first correction is linear in the length.
Point limit(const Griffith& exact, double angle) {
  const Point coarse = intensities(kinked(0.02, angle), exact, 0.02);
  const Point fine = intensities(kinked(0.01, angle), exact, 0.01);
  return 2 * fine - coarse;
}

TEST(Kink, InfinitesimalKinksHaveTheFactorsOfAmestoyAndLeblond) {
  // Amestoy and Leblond 1992: k = F K. Rows: degrees, F11, F12, F21, F22.
  constexpr double table[][5] = {
      {15, 0.974588, -0.385578, 0.128128, 0.947227},    {30, 0.901738, -0.729842, 0.240249, 0.797161},
      {45, 0.790898, -0.998203, 0.323280, 0.572903},    {60, 0.655670, -1.167992, 0.369250, 0.307871},
      {70.53, 0.554359, -1.223322, 0.378112, 0.117687}, {90, 0.371872, -1.193465, 0.348080, -0.196558}};
  for (const auto& [degrees, F11, F12, F21, F22] : table) {
    const double angle = degrees * std::numbers::pi / 180;
    const Griffith opening{.normal = 1, .shear = 0, .along = 1, .rock = {1, 1.5}};
    const Griffith sliding{.normal = 0, .shear = 1, .along = 0, .rock = {1, 1.5}};
    const double unit = opening.K().x();
    const std::string at = std::to_string(static_cast<int>(degrees));
    EXPECT_LT(relative_error(limit(opening, angle) / unit, {F11, F21}, "opening at " + at), 3e-3) << degrees;
    EXPECT_LT(relative_error(limit(sliding, angle) / unit, {F12, F22}, "sliding at " + at), 3e-3) << degrees;
  }
}

TEST(Kink, MirrorImageHasTheSameOpeningAndTheOppositeShear) {
  const Griffith exact{.normal = 1, .shear = 0, .along = 1, .rock = {1, 1.5}};
  const Point up = intensities(kinked(0.1, 0.8), exact, 0.1), down = intensities(kinked(0.1, -0.8), exact, 0.1);
  EXPECT_NEAR(up.x(), down.x(), 1e-3 * up.x());
  EXPECT_NEAR(up.y(), -down.y(), 1e-3 * up.x());
}

TEST(Kink, ShortLastSegmentsShrinkTheRosetteAndKeepTheAccuracy) {
  // A kink of 3 mm on the paper's crack with the paper's mesh, against a mesh made for it.
  const Griffith exact = paper_crack(1e6, 0.7e6);
  FineGeometry geometry = paper_box();
  const Point end = Point(0.05, 0) + 0.003 * Point(std::cos(-0.7), std::sin(-0.7));
  geometry.cracks[0] = {{{-0.05, 0}, {0.05, 0}, end}, true, true, {Walls::traction, Walls::traction}};
  const FineMeshOptions made_for_it{
      .tip_size = 0.0005, .far_size = 0.1, .growth = 0.2, .sectors = 24, .kink_size = 5e-5};
  const FineSolution coarse = FineModel(geometry, paper_mesh(), table_1_rock).solve(exact_outline(exact));
  const FineSolution fine = FineModel(geometry, made_for_it, table_1_rock).solve(exact_outline(exact));
  EXPECT_DOUBLE_EQ(coarse.mesh->tips[1].room.radius, 0.0015);
  EXPECT_LT(relative_error(coarse.tips[1].K, fine.tips[1].K, "K"), 1e-2);
}

TEST(Kink, ParallelCracksNearEachOtherShareTheRoom) {
  FineGeometry geometry{rectangle(-0.25, -0.25, 0.25, 0.25),
                        {inner_crack({-0.05, 0}, {0.05, 0}), inner_crack({0.03, 0.01}, {0.12, 0.01})}};
  const FineModel model(geometry, paper_mesh(), table_1_rock);
  const FineSolution solution = model.solve(exact_outline(paper_crack(1e6, 0)));
  ASSERT_EQ(solution.tips.size(), 4u);
  for (const TipIntensities& tip : solution.tips) {
    EXPECT_GT(tip.K.x(), 0);
    EXPECT_LT(tip.error.norm(), 2e-2 * tip.K.norm());
  }
  EXPECT_DOUBLE_EQ(model.mesh().tips[1].room.radius, 0.01 / 3);
}

TEST(Kink, TheFactorsOfOneTipAreThoseAmongAll) {
  FineGeometry geometry{rectangle(-0.25, -0.25, 0.25, 0.25),
                        {inner_crack({-0.05, 0}, {0.05, 0}), inner_crack({0.03, 0.01}, {0.12, 0.01})}};
  const FineLoads loads = exact_outline(paper_crack(1e6, 0.3e6));
  const FineSolution all = FineModel(geometry, paper_mesh(), table_1_rock).solve(loads);
  for (const TipIntensities& tip : all.tips) {
    const TipPlace place{tip.crack, tip.is_last};
    const FineSolution one = FineModel(geometry, paper_mesh(), table_1_rock, place).solve(loads);
    ASSERT_EQ(one.tips.size(), 1u);
    EXPECT_EQ(one.tips[0].position, tip.position);
    EXPECT_EQ(one.tips[0].K, tip.K);
    EXPECT_EQ(one.tips[0].T, tip.T);
    EXPECT_EQ(one.tips[0].error, tip.error);
  }
}

TEST(Kink, GeometryThatCannotBeMeshedIsRefused) {
  const auto refuse = [](const FineGeometry& geometry) {
    EXPECT_THROW(make_fine_mesh(geometry, paper_mesh()), std::invalid_argument);
  };
  FineGeometry geometry = paper_box();
  std::reverse(geometry.outline.begin(), geometry.outline.end());
  refuse(geometry);
  geometry = paper_box();
  geometry.cracks[0].points[1] = {0.3, 0};
  refuse(geometry);
  geometry = paper_box();
  geometry.cracks[0].last_is_tip = false;
  refuse(geometry);
  geometry = paper_box();
  geometry.cracks[0].walls.clear();
  refuse(geometry);
  geometry = paper_box();
  geometry.cracks.push_back(inner_crack({0, -0.1}, {0, 0.1}));
  refuse(geometry);
  FineMeshOptions odd = paper_mesh();
  odd.sectors = 7;
  EXPECT_THROW(make_fine_mesh(paper_box(), odd), std::invalid_argument);
}

}  // namespace
}  // namespace sprekk::test
