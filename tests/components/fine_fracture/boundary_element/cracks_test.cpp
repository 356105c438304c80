// Cracks in an infinite plate by boundary elements: straight, kinked, crossing, and ending outside of the outline.
#include <numbers>

#include "tests/components/fine_fracture/boundary_element/cases.hpp"

namespace sprekk::test {
namespace {

using std::numbers::pi;

/// The exact field of a crack in the box of the paper, turned, or mirrored.
struct Placed {
  Griffith exact;
  Tensor turn;
  FineLoads loads() const {
    return {.boundary_displacement = [*this](const Point& x, const Point& inside) -> Point {
      return turn * exact.displacement(turn.transpose() * x, turn.transpose() * inside);
    }};
  }
};

TEST(BoundaryCracks, StraightCrackHasTheFactorsOfGriffithInAnyDirection) {
  for (const auto& [normal, shear] : {std::pair{1e6, 0.0}, std::pair{0.0, 1e6}, std::pair{1e6, 0.7e6}})
    for (const double angle : {0.0, 0.47, 0.47 + 1e-9, -2.6})
      for (const bool is_mirrored : {false, true}) {
        const Placed placed{paper_crack(normal, shear, -3e6), turn_by(angle, is_mirrored)};
        const Point end = placed.turn * Point(0.05, 0);
        const FineGeometry geometry{rectangle(-0.25, -0.25, 0.25, 0.25), {inner_crack(-end, end)}};
        const Point K = placed.exact.K().cwiseProduct(Point(1, is_mirrored ? -1 : 1));
        for (const bool is_last : {false, true}) {
          const TipFactors found = boundary_factors(geometry, table_1_rock, {0, is_last}, placed.loads(), 0.02);
          EXPECT_LT((intensities_of(found) - K).norm(), 1e-5 * K.norm()) << angle;
          EXPECT_NEAR(found.sifs.t_stress, placed.exact.T(), 1e-5 * 3e6) << angle;
        }
      }
}

TEST(BoundaryCracks, ErrorsAreSmallWhateverTheElements) {
  const Griffith exact = paper_crack(1e6, 0.7e6);
  for (const double largest : {0.1, 0.05, 0.025, 0.0125}) {
    const TipFactors found = boundary_factors(paper_box(), table_1_rock, {0, true}, exact_outline(exact), largest);
    EXPECT_LT(relative_error(intensities_of(found), exact.K(), "K at " + std::to_string(largest)), 1e-5);
    EXPECT_LT(found.error, 1e-4 * exact.K().norm());
  }
}

/// Elements of another geometry change factors by the error of the elements.
TEST(BoundaryCracks, FactorsWithThePatternOfANeighbourAreContinuous) {
  const Griffith exact = paper_crack(1e6, 0.7e6, -3e6);
  const auto kinked = [](double length) {
    FineGeometry geometry = paper_box();
    const Point end = Point(0.05, 0) + length * Point(std::cos(-0.7), std::sin(-0.7));
    geometry.cracks[0] = {{{-0.05, 0}, {0.05, 0}, end}, true, true, {Walls::traction, Walls::traction}};
    return geometry;
  };
  const BoundaryOptions options{.sizes = {.largest = 0.02}, .spacing = 0.01};
  const BoundaryPattern pattern = BoundaryModel(kinked(0.01), options, table_1_rock, {0, true}).pattern();
  const FineLoads loads = exact_outline(exact);
  for (const double length : {0.009, 0.0099, 0.01, 0.0101, 0.011}) {
    const BoundaryModel own(kinked(length), options, table_1_rock, {0, true}),
        other(kinked(length), options, table_1_rock, {0, true}, std::make_shared<Profile>(), &pattern);
    EXPECT_EQ(other.topology(), BoundaryModel(kinked(0.01), options, table_1_rock, {0, true}).topology());
    const TipFactors a = own.solve(loads), b = other.solve(loads);
    EXPECT_LT(relative_error(intensities_of(b), intensities_of(a), "K at " + std::to_string(length)), 1e-4);
  }
}

/// A crack that leaves the domain: what it does outside is known.
TEST(BoundaryCracks, CrackThatLeavesTheDomainHasTheFactorsOfGriffith) {
  const Placed placed{{.normal = 1, .shear = 0.7, .rock = {1, 1.5}}, turn_by(0.3)};
  // The domain has the tip at (1, 0) alone.
  const auto at = [&](double x) -> Point { return placed.turn * Point(x, 0); };
  const Point center = at(1);
  const std::vector<Point> outline = rectangle(center[0] - 0.5, center[1] - 0.5, center[0] + 0.5, center[1] + 0.5);
  const double leaves = 1 - 0.5 / std::cos(0.3);
  FineGeometry geometry{outline, {{{at(leaves), at(1)}, false, true, {Walls::traction}}}};
  geometry.cracks[0].points[0][0] = outline[0][0];
  geometry.beyond = {{geometry.cracks[0].points[0], at(-1)}};
  FineLoads loads = placed.loads();
  loads.jump_beyond = [&](int, int, double s) -> Point {
    return -(placed.turn * placed.exact.jump(leaves + s * (-1 - leaves)));  // the path leads backwards
  };
  const TipFactors found = boundary_factors(geometry, placed.exact.rock, {0, true}, loads, 0.2);
  EXPECT_LT(relative_error(intensities_of(found), placed.exact.K(), "K"), 1e-3);
  EXPECT_NEAR(found.sifs.t_stress, placed.exact.T(), 1e-3);
}

/// A crack of half-length 1 whose right end has a kink of the given length and angle (counter-clockwise).
FineGeometry kinked(double length, double angle) {
  const Point end = Point(1, 0) + length * Point(std::cos(angle), std::sin(angle));
  return {rectangle(-4, -4, 4, 4), {{{{-1, 0}, {1, 0}, end}, true, true, {Walls::traction, Walls::traction}}}};
}

/// Of an infinitesimal kink: along = normal makes T vanish, so that the first correction is linear in the length.
Point limit(const Griffith& exact, double angle) {
  const auto at = [&](double length) {
    return intensities_of(boundary_factors(kinked(length, angle), exact.rock, {0, true}, exact_outline(exact), 0.5));
  };
  return 2 * at(0.005) - at(0.01);
}

TEST(BoundaryCracks, InfinitesimalKinksHaveTheFactorsOfAmestoyAndLeblond) {
  // Amestoy and Leblond 1992: k = F K. Rows: degrees, F11, F12, F21, F22.
  constexpr double table[][5] = {
      {15, 0.974588, -0.385578, 0.128128, 0.947227},    {30, 0.901738, -0.729842, 0.240249, 0.797161},
      {45, 0.790898, -0.998203, 0.323280, 0.572903},    {60, 0.655670, -1.167992, 0.369250, 0.307871},
      {70.53, 0.554359, -1.223322, 0.378112, 0.117687}, {90, 0.371872, -1.193465, 0.348080, -0.196558}};
  for (const auto& [degrees, F11, F12, F21, F22] : table) {
    const double angle = degrees * pi / 180;
    const Griffith opening{.normal = 1, .shear = 0, .along = 1, .rock = {1, 1.5}};
    const Griffith sliding{.normal = 0, .shear = 1, .along = 0, .rock = {1, 1.5}};
    const double unit = opening.K().x();
    const std::string at = std::to_string(static_cast<int>(degrees));
    EXPECT_LT(relative_error(limit(opening, angle) / unit, {F11, F21}, "opening at " + at), 1e-3) << degrees;
    EXPECT_LT(relative_error(limit(sliding, angle) / unit, {F12, F22}, "sliding at " + at), 1e-3) << degrees;
  }
}

}  // namespace
}  // namespace sprekk::test
