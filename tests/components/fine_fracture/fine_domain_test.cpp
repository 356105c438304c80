// The piece of rock around a tip: what a square cuts out of the paths of fractures.
#include "components/fine_fracture/fine_level/fine_domain.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/mesh/build_mesh.hpp"
#include "tests/components/fine_fracture/rock_with_fractures.hpp"

namespace sprekk::test {
namespace {

const std::vector<Point> kinked{Point(0.5, 0.5), Point(0.9, 0.8), Point(1.4, 0.8)};

TEST(FineDomain, OfACrackThatLeavesTheSquare) {
  const Mesh mesh = rock_with({{Point(0.5, 0.5), Point(1, 0.5)}});
  for (const bool at_end : {false, true}) {
    const Point tip(at_end ? 1 : 0.5, 0.5);
    const FineDomain domain = fine_domain(mesh, paths_of(mesh), {0, at_end}, tip, 0.4, gap, Walls::jump);
    EXPECT_NO_THROW(validate(domain.geometry));
    const Point half(0.2, 0.2);
    const Point low = tip - half, high = tip + half;
    expect_points(domain.geometry.outline, {low, Point(high[0], low[1]), high, Point(low[0], high[1])});
    ASSERT_EQ(domain.geometry.cracks.size(), 1u);
    const CrackPath& crack = domain.geometry.cracks[0];
    // It goes from the first to the last point, as the fracture does.
    expect_points(crack.points, at_end ? std::vector{Point(0.8, 0.5), tip} : std::vector{tip, Point(0.7, 0.5)});
    EXPECT_EQ(crack.first_is_tip, !at_end);
    EXPECT_EQ(crack.last_is_tip, at_end);
    EXPECT_EQ(crack.walls, std::vector{Walls::jump});
    EXPECT_EQ(domain.sources[0].fracture, 0);
    expect_lengths(domain.sources[0].arc, at_end ? std::vector{0.3, 0.5} : std::vector{0.0, 0.2});
    EXPECT_EQ(domain.crack, 0);
    EXPECT_EQ(domain.is_last, at_end);
  }
}

TEST(FineDomain, OfACrackWithBothTipsInside) {
  const Mesh mesh = rock_with({{Point(0.9, 0.5), Point(1.1, 0.5)}});
  for (const bool at_end : {false, true}) {
    const FineDomain domain = fine_domain(mesh, paths_of(mesh), {0, at_end}, Point(1, 0.5), 0.6, gap, Walls::traction);
    EXPECT_NO_THROW(validate(domain.geometry));
    ASSERT_EQ(domain.geometry.cracks.size(), 1u);
    const CrackPath& crack = domain.geometry.cracks[0];
    expect_points(crack.points, {Point(0.9, 0.5), Point(1.1, 0.5)});
    EXPECT_TRUE(crack.first_is_tip);
    EXPECT_TRUE(crack.last_is_tip);
    EXPECT_EQ(domain.crack, 0);
    EXPECT_EQ(domain.is_last, at_end);
  }
}

TEST(FineDomain, WithOtherFracturesInAroundAndAcrossIt) {
  // Around (1, 0.5): 0 passes through, 1 lies inside, 2 far away, 3 has the tip and begins outside.
  const Mesh mesh = rock_with({{Point(0.6, 0.62), Point(1.5, 0.6)},
                               {Point(0.95, 0.4), Point(1.05, 0.38)},
                               {Point(0.1, 0.1), Point(0.3, 0.1)},
                               {Point(0.3, 0.5), Point(1, 0.5)}});
  const FineDomain domain = fine_domain(mesh, paths_of(mesh), {3, true}, Point(1, 0.5), 0.4, gap, Walls::traction);
  EXPECT_NO_THROW(validate(domain.geometry));
  ASSERT_EQ(domain.geometry.cracks.size(), 3u);
  ASSERT_EQ(domain.sources.size(), 3u);
  EXPECT_EQ(domain.sources[0].fracture, 0);
  EXPECT_EQ(domain.sources[1].fracture, 1);
  EXPECT_EQ(domain.sources[2].fracture, 3);
  EXPECT_EQ(domain.crack, 2);
  EXPECT_TRUE(domain.is_last);
  const auto on_first = [](double x) { return Point(x, 0.62 - 0.02 * (x - 0.6) / 0.9); };
  const CrackPath& across = domain.geometry.cracks[0];
  expect_points(across.points, {on_first(0.8), on_first(1.2)});
  EXPECT_FALSE(across.first_is_tip || across.last_is_tip);
  const double stretch = std::hypot(0.9, 0.02) / 0.9;
  expect_lengths(domain.sources[0].arc, {0.2 * stretch, 0.6 * stretch});
  EXPECT_TRUE(domain.geometry.cracks[1].first_is_tip && domain.geometry.cracks[1].last_is_tip);
}

TEST(FineDomain, OfACrackThatLeavesAndComesBack) {
  // Out at the right, back higher up: two cracks of one fracture; only the second one has the tip.
  const Mesh mesh = rock_with({{Point(0.9, 0.42), Point(1.4, 0.42), Point(1.4, 0.6), Point(1, 0.6)}});
  const FineDomain domain = fine_domain(mesh, paths_of(mesh), {0, true}, Point(1, 0.5), 0.4, gap, Walls::traction);
  EXPECT_NO_THROW(validate(domain.geometry));
  ASSERT_EQ(domain.geometry.cracks.size(), 2u);
  const CrackPath &first = domain.geometry.cracks[0], &second = domain.geometry.cracks[1];
  expect_points(first.points, {Point(0.9, 0.42), Point(1.2, 0.42)});
  expect_points(second.points, {Point(1.2, 0.6), Point(1, 0.6)});
  EXPECT_TRUE(first.first_is_tip && !first.last_is_tip);
  EXPECT_TRUE(!second.first_is_tip && second.last_is_tip);
  expect_lengths(domain.sources[0].arc, {0, 0.3});
  expect_lengths(domain.sources[1].arc, {0.5 + 0.18 + 0.2, 0.5 + 0.18 + 0.4});
  EXPECT_EQ(domain.crack, 1);
  const FineDomain of_first = fine_domain(mesh, paths_of(mesh), {0, false}, Point(1, 0.5), 0.4, gap, Walls::traction);
  EXPECT_EQ(of_first.crack, 0);
  EXPECT_FALSE(of_first.is_last);
}

TEST(FineDomain, EndsAtTheRock) {
  // Nearer to the right side and the top than half the size, with a fracture that goes to the right side.
  const Mesh mesh = rock_with({{Point(1.5, 0.9), Point(1.9, 0.9)}, {Point(1.8, 0.8), Point(2, 0.75)}});
  const FineDomain domain = fine_domain(mesh, paths_of(mesh), {0, true}, Point(1.9, 0.9), 0.4, gap, Walls::traction);
  EXPECT_NO_THROW(validate(domain.geometry));
  expect_points(domain.geometry.outline, {Point(1.7, 0.7), Point(2, 0.7), Point(2, 1), Point(1.7, 1)});
  ASSERT_EQ(domain.geometry.cracks.size(), 2u);
  expect_points(domain.geometry.cracks[0].points, {Point(1.7, 0.9), Point(1.9, 0.9)});
  expect_points(domain.geometry.cracks[1].points, {Point(1.8, 0.8), Point(2, 0.75)});
  EXPECT_TRUE(domain.geometry.cracks[1].first_is_tip);
  EXPECT_FALSE(domain.geometry.cracks[1].last_is_tip);
}

TEST(FineDomain, WallsThatHaveBeenAddedFeelTractions) {
  const Mesh mesh = rock_with({{Point(0.9, 0.5), Point(1.1, 0.5)}});
  const TipPath first{{Point(0.85, 0.48), Point(0.8, 0.49)}}, last{{Point(1.2, 0.5)}};
  const std::vector<FracturePath> paths{fracture_path(mesh, 0, first, last)};
  for (const bool at_end : {false, true}) {
    const FineDomain domain = fine_domain(mesh, paths, {0, at_end}, Point(1, 0.5), 0.8, gap, Walls::jump);
    EXPECT_NO_THROW(validate(domain.geometry));
    ASSERT_EQ(domain.geometry.cracks.size(), 1u);
    const CrackPath& crack = domain.geometry.cracks[0];
    expect_points(crack.points,
                  {Point(0.8, 0.49), Point(0.85, 0.48), Point(0.9, 0.5), Point(1.1, 0.5), Point(1.2, 0.5)});
    EXPECT_EQ(crack.walls, (std::vector{Walls::traction, Walls::traction, Walls::jump, Walls::traction}));
    // The tip is the end of what has been added.
    EXPECT_TRUE(crack.first_is_tip && crack.last_is_tip);
    EXPECT_EQ(domain.is_last, at_end);
    const double kinked = std::hypot(0.05, 0.02), oblique = std::hypot(0.05, 0.01);
    expect_lengths(domain.sources[0].arc, {-kinked - oblique, -kinked, 0, 0.2, 0.3});
  }
}

double width(const FineDomain& domain) { return domain.geometry.outline[1][0] - domain.geometry.outline[0][0]; }

TEST(FineDomain, KeepsItsOutlineAwayFromTips) {
  for (const double away : {-0.009, -0.004, 0.0, 0.004, 0.009}) {
    // The other end of the crack lies `away` outside of the square.
    const double x = 0.8 - away;
    const Mesh mesh = rock_with({{Point(x, 0.5), Point(1, 0.5)}});
    const FineDomain domain = fine_domain(mesh, paths_of(mesh), {0, true}, Point(1, 0.5), 0.4, gap, Walls::traction);
    EXPECT_NO_THROW(validate(domain.geometry));
    EXPECT_GE(std::abs(x - domain.geometry.outline[0][0]), gap);
    EXPECT_GT(width(domain), 0.4);
    EXPECT_LT(width(domain), 0.4 + 2 * (2 * gap + 0.02 * 0.4));
  }
  // With enough room the square is not made larger.
  for (const double away : {-0.011, 0.011}) {
    const Mesh mesh = rock_with({{Point(0.8 - away, 0.5), Point(1, 0.5)}});
    const FineDomain domain = fine_domain(mesh, paths_of(mesh), {0, true}, Point(1, 0.5), 0.4, gap, Walls::traction);
    EXPECT_NEAR(width(domain), 0.4, rounding);
  }
}

TEST(FineDomain, KeepsItsOutlineFartherAwayFromSharperKinks) {
  // A kink of another fracture lies `away` outside of the right side of the square. Its gap goes with the sine of the
  // bend: 8 times that, and at most 4.
  struct Case {
    double degrees, gaps;
  };
  for (const auto& [degrees, gaps] :
       {Case{90, 4}, Case{150, 4}, Case{30, 4}, Case{10, 8 * 0.17364817766693}, Case{1, 0.25}})
    for (const double of_gap : {-0.95, -0.4, 0.0, 0.4, 0.95, 1.05})
      for (const double turn : {-1.0, 1.0}) {
        const double x = 1.2 + of_gap * gaps * gap, angle = degrees * std::numbers::pi / 180;
        const Point kink(x, 0.5 + 0.05 * turn), arm = 0.1 * Point(std::cos(0.5 * angle), turn * std::sin(0.5 * angle));
        const Mesh mesh =
            rock_with({{Point(0.9, 0.5), Point(1, 0.5)}, {kink - arm, kink, kink + Point(arm[0], -arm[1])}});
        const FineDomain domain =
            fine_domain(mesh, paths_of(mesh), {0, true}, Point(1, 0.5), 0.4, gap, Walls::traction);
        EXPECT_NO_THROW(validate(domain.geometry));
        EXPECT_GE(std::abs(x - domain.geometry.outline[1][0]), gaps * gap - rounding) << degrees << " " << of_gap;
        if (std::abs(of_gap) > 1)
          EXPECT_NEAR(width(domain), 0.4, rounding) << degrees;
        else
          EXPECT_GT(width(domain), 0.4) << degrees << " " << of_gap;
      }
}

TEST(FineDomain, KeepsItsCornersAwayFromKinks) {
  // The kink lies beyond a corner of the square, on the line through both.
  for (const double gaps : {0.1, 2.0, 3.9, 4.1})
    for (const double mirrored : {1.0, -1.0}) {
      const double away = gaps * gap;
      const Point kink(1.2 + away, 0.5 + mirrored * (0.2 + away));
      const Mesh mesh =
          rock_with({{Point(0.9, 0.5), Point(1, 0.5)}, {kink + Point(0.1, 0), kink, kink + Point(0, 0.1 * mirrored)}});
      const FineDomain domain = fine_domain(mesh, paths_of(mesh), {0, true}, Point(1, 0.5), 0.4, gap, Walls::traction);
      EXPECT_NO_THROW(validate(domain.geometry));
      if (gaps > 4) {
        EXPECT_NEAR(width(domain), 0.4, rounding);
        continue;
      }
      EXPECT_GT(width(domain), 0.4) << gaps;
      const Point corner(domain.geometry.outline[1][0], 0.5 + 0.5 * mirrored * width(domain));
      EXPECT_GE((kink - corner).cwiseAbs().maxCoeff(), 4 * gap - rounding) << gaps;
    }
}

TEST(FineDomain, KeepsItsOutlineAwayFromFracturesThatRunAlongIt) {
  for (const double away : {-0.009, -1e-6, 0.0, 1e-6, 0.009}) {
    // Past both ends of the lower side of the square, and of the left one.
    const double y = 0.3 + away, x = 0.8 + away;
    for (const bool is_upright : {false, true}) {
      const Mesh mesh = rock_with(
          {{Point(0.9, 0.5), Point(1, 0.5)},
           is_upright ? std::vector{Point(x, 0.1), Point(x, 0.9)} : std::vector{Point(0.2, y), Point(1.6, y)}});
      const FineDomain domain = fine_domain(mesh, paths_of(mesh), {0, true}, Point(1, 0.5), 0.4, gap, Walls::traction);
      EXPECT_NO_THROW(validate(domain.geometry));
      const Point low = domain.geometry.outline[0];
      EXPECT_GE(is_upright ? std::abs(x - low[0]) : std::abs(y - low[1]), gap);
    }
  }
  // A crack that crosses a side, or leaves through a corner of the square, is no reason for a larger one.
  const Mesh diagonal = rock_with({{Point(0.6, 0.1), Point(1, 0.5)}});
  EXPECT_NEAR(width(fine_domain(diagonal, paths_of(diagonal), {0, true}, Point(1, 0.5), 0.4, gap, Walls::traction)),
              0.4, rounding);
}

TEST(FineDomain, KeepsAsFarAwayAsItCan) {
  // A zigzag with a sharp kink every 12 mm leaves the square: no outline is 40 mm away from all of them. Squares grow
  // by 4 mm a side, so that one is at least 4 mm away from the kinks on its both sides.
  std::vector<Point> zigzag;
  for (int i = 0; i <= 60; ++i) zigzag.push_back(Point(1 - 0.012 * i, 0.5 + (i % 2 == 0 ? 0 : 0.004)));
  const Mesh mesh = rock_with({zigzag});
  for (const double shift : {0.0, 0.001, 0.005, 0.011}) {
    const FineDomain domain =
        fine_domain(mesh, paths_of(mesh), {0, false}, Point(1 + shift, 0.5), 0.4, gap, Walls::traction);
    EXPECT_NO_THROW(validate(domain.geometry));
    double nearest = gap;
    for (const Point& x : zigzag) nearest = std::min(nearest, std::abs(x[0] - domain.geometry.outline[0][0]));
    EXPECT_GE(nearest, 0.004 - rounding);
    EXPECT_LT(width(domain), largest_enlargement * 0.4);
  }
}

TEST(FineDomain, DoesNotAvoidTheRocksOwnBoundary) {
  // An end on the outer boundary is no reason for a larger square.
  const Mesh mesh = rock_with({{Point(0, 0.5), Point(0.15, 0.5)}});
  const FineDomain domain = fine_domain(mesh, paths_of(mesh), {0, true}, Point(0.15, 0.5), 0.4, gap, Walls::traction);
  EXPECT_NO_THROW(validate(domain.geometry));
  expect_points(domain.geometry.outline, {Point(0, 0.3), Point(0.35, 0.3), Point(0.35, 0.7), Point(0, 0.7)});
  expect_points(domain.geometry.cracks[0].points, {Point(0, 0.5), Point(0.15, 0.5)});
  EXPECT_FALSE(domain.geometry.cracks[0].first_is_tip);
}

TEST(FineDomain, WithFracturesThatMeetInItAndOutside) {
  // The tip at (1.2, 0.5); one fracture crosses at (1, 0.5), one touches at (1.1, 0.5) and goes on outside; two meet
  // outside.
  const Mesh mesh = rock_with({{Point(0.4, 0.5), Point(1.2, 0.5)},
                               {Point(1, 0.4), Point(1, 0.6)},
                               {Point(1.1, 0.5), Point(1.1, 0.9)},
                               {Point(0.6, 0.3), Point(0.6, 0.7)}});
  const FineDomain domain = fine_domain(mesh, paths_of(mesh), {0, true}, Point(1.2, 0.5), 0.6, gap, Walls::jump);
  EXPECT_NO_THROW(validate(domain.geometry));
  ASSERT_EQ(domain.geometry.cracks.size(), 3u);
  const auto& cracks = domain.geometry.cracks;
  expect_points(cracks[0].points, {Point(0.9, 0.5), Point(1, 0.5), Point(1.1, 0.5), Point(1.2, 0.5)});
  expect_points(cracks[1].points, {Point(1, 0.4), Point(1, 0.5), Point(1, 0.6)});
  expect_points(cracks[2].points, {Point(1.1, 0.5), Point(1.1, 0.8)});
  EXPECT_TRUE(cracks[1].first_is_tip && cracks[1].last_is_tip);
  EXPECT_FALSE(cracks[2].first_is_tip || cracks[2].last_is_tip);
  const auto meetings = junctions(domain.geometry);
  ASSERT_EQ(meetings.size(), 2u);
  // To the last digit one point for both.
  EXPECT_EQ(cracks[0].points[1], cracks[1].points[1]);
  EXPECT_EQ(cracks[0].points[2], cracks[2].points[0]);
}

TEST(FineDomain, WithAPathThatReachesAnotherFractureBeforeTheMeshKnows) {
  // From (0.8, 0.7) down to (0.8, 0.5), in the middle of a straight fracture whose tip is at (1, 0.5).
  const Mesh mesh = rock_with({{Point(0.4, 0.5), Point(1, 0.5)}, {Point(0.8, 0.9), Point(0.8, 0.7)}});
  const std::vector<FracturePath> paths{fracture_path(mesh, 0, {}, {}),
                                        fracture_path(mesh, 1, {}, TipPath{{Point(0.8, 0.6), Point(0.8, 0.5)}})};
  const FineDomain domain = fine_domain(mesh, paths, {0, true}, Point(1, 0.5), 0.6, gap, Walls::jump);
  EXPECT_NO_THROW(validate(domain.geometry));
  ASSERT_EQ(domain.geometry.cracks.size(), 2u);
  const CrackPath &through = domain.geometry.cracks[0], &joining = domain.geometry.cracks[1];
  expect_points(through.points, {Point(0.7, 0.5), Point(0.8, 0.5), Point(1, 0.5)});
  expect_lengths(domain.sources[0].arc, {0.3, 0.4, 0.6});
  EXPECT_EQ(through.walls, (std::vector{Walls::jump, Walls::jump}));
  expect_points(joining.points, {Point(0.8, 0.8), Point(0.8, 0.7), Point(0.8, 0.5)});
  EXPECT_EQ(joining.walls, (std::vector{Walls::jump, Walls::traction}));
  EXPECT_FALSE(joining.last_is_tip);
  EXPECT_EQ(junctions(domain.geometry).size(), 1u);
}

TEST(FineDomain, KeepsItsOutlineAwayFromJunctions) {
  for (const double away : {-0.009, -0.004, 0.0, 0.004, 0.009}) {
    // A fracture crosses the one with the tip where the outline would be, or touches it there.
    const Point at(0.8 + away, 0.5);
    for (const Point& begin : {Point(at + Point(-0.1, -0.3)), at}) {
      const Mesh mesh = rock_with({{Point(0.4, 0.5), Point(1, 0.5)}, {begin, at + Point(0.1, 0.3)}});
      const FineDomain domain = fine_domain(mesh, paths_of(mesh), {0, true}, Point(1, 0.5), 0.4, gap, Walls::traction);
      EXPECT_NO_THROW(validate(domain.geometry));
      EXPECT_GE(std::abs(at[0] - domain.geometry.outline[0][0]), gap);
      EXPECT_EQ(junctions(domain.geometry).size(), at[0] > domain.geometry.outline[0][0] ? 1u : 0u);
    }
  }
}

TEST(FineDomain, RefusesASquareWithoutTheTip) {
  const Mesh mesh = rock_with({{Point(0.5, 0.5), Point(1, 0.5)}});
  EXPECT_THROW(fine_domain(mesh, paths_of(mesh), {0, true}, Point(0.5, 0.5), 0.4, gap, Walls::traction),
               std::runtime_error);
}

// A rock that is turned is not its bounding box: squares stay in it, and are as large as they can be.
TEST(FineDomain, StaysInRockWithSlantedSides) {
  const Point middle(1, 0.5);
  for (const double angle : {30.0, -20.0, 45.0, 90.0, 0.0}) {
    const double c = std::cos(angle * std::numbers::pi / 180), s = std::sin(angle * std::numbers::pi / 180);
    const auto turned = [&](const Point& x, double sense) {
      const Point off = x - middle;
      return Point(middle + Point(c * off[0] - sense * s * off[1], sense * s * off[0] + c * off[1]));
    };
    RawMesh raw = to_raw_mesh(rock_with({{Point(0.9, 0.5), Point(1.1, 0.5)}}));
    for (Point& x : raw.nodes) x = turned(x, 1);
    const Mesh mesh = build_mesh(raw);
    const Point tip = turned({1.1, 0.5}, 1);
    // A square of this side touches the long sides of the rock.
    const double largest = 1 / (std::abs(c) + std::abs(s));
    for (const double size : {0.2, 0.6, 1.5}) {
      const FineDomain domain = fine_domain(mesh, paths_of(mesh), {0, true}, tip, size, gap, Walls::traction);
      const std::vector<Point>& outline = domain.geometry.outline;
      for (std::size_t i = 0; i < 4; ++i)
        for (const double part : {0.0, 0.25, 0.5, 0.75}) {
          const Point x = turned(outline[i] + part * (outline[(i + 1) % 4] - outline[i]), -1);
          EXPECT_GT(std::min({x[0], x[1], 2 - x[0], 1 - x[1]}), -1e-8) << angle << ", " << size;
        }
      const double side = (outline[2] - outline[0]).minCoeff();
      EXPECT_LE(side, std::min(size, largest) * (1 + 1e-8));
      EXPECT_GE(side, std::min(size, largest) - 0.02 * size - 1e-8) << angle << ", " << size;
      const bool is_box = std::abs(s * c) < 1e-9;  // the long sides do not count then
      EXPECT_NEAR(reach_in_rock(mesh, outline, tip), 0.5 * (is_box ? size : side), 1e-8) << angle << ", " << size;
    }
  }
}

}  // namespace
}  // namespace sprekk::test
