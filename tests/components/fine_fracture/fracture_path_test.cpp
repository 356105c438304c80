// Paths of fractures on the fine level.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/components/fine_fracture/rock_with_fractures.hpp"

namespace sprekk::test {
namespace {

const std::vector<Point> kinked{Point(0.5, 0.5), Point(0.9, 0.8), Point(1.4, 0.8)};  // lengths 0.5 and 0.5

TEST(FracturePath, MergesCellsOfAStraightPieceAndKeepsKinks) {
  const Mesh mesh = rock_with({{Point(0.1, 0.1), Point(0.4, 0.1)}, kinked});
  ASSERT_GT(mesh.fractures[1].cell_count, 8);
  const FracturePath path = fracture_path(mesh, 1, {}, {});
  expect_points(path.points, kinked);
  expect_lengths(path.arc, {0, 0.5, 1});
  EXPECT_NEAR(path.length, 1, rounding);
  EXPECT_TRUE(path.first_is_tip);
  EXPECT_TRUE(path.last_is_tip);
}

TEST(FracturePath, CountsWhatIsAddedBelowZeroAndAboveTheLength) {
  const Mesh mesh = rock_with({kinked});
  // At the first point 0.1 to the left and then 0.2 down; at the last one 0.05 up, 0.3 to the right.
  const TipPath first{{Point(0.4, 0.5), Point(0.4, 0.3)}}, last{{Point(1.4, 0.85), Point(1.7, 0.85)}};
  const FracturePath path = fracture_path(mesh, 0, first, last);
  expect_points(path.points, {Point(0.4, 0.3), Point(0.4, 0.5), kinked[0], kinked[1], kinked[2], Point(1.4, 0.85),
                              Point(1.7, 0.85)});
  expect_lengths(path.arc, {-0.3, -0.1, 0, 0.5, 1, 1.05, 1.35});
  EXPECT_NEAR(path.length, 1, rounding);
}

TEST(FracturePath, KeepsTheEndsOfTheCoarseLevelWhereGrowthIsStraight) {
  const Mesh mesh = rock_with({{Point(0.5, 0.5), Point(1, 0.5)}});
  // Two points straight ahead at either end: they become one segment, which begins at the coarse end.
  const TipPath first{{Point(0.4, 0.5), Point(0.2, 0.5)}}, last{{Point(1.1, 0.5), Point(1.3, 0.5)}};
  const FracturePath path = fracture_path(mesh, 0, first, last);
  expect_points(path.points, {Point(0.2, 0.5), Point(0.5, 0.5), Point(1, 0.5), Point(1.3, 0.5)});
  expect_lengths(path.arc, {-0.3, 0, 0.5, 0.8});
}

TEST(FracturePath, BendsItsLastCellsByTheirCorners) {
  const Mesh mesh = rock_with({kinked});
  const Fracture& cells = mesh.fractures[0];
  const FractureCell &first = mesh.fracture_cells[cells.first_cell],
                     &last = mesh.fracture_cells[cells.first_cell + cells.cell_count - 1];
  const Point bent_first = first.center + Point(0, 1e-3), bent_last = last.center + Point(2e-3, 0);
  const FracturePath path =
      fracture_path(mesh, 0, {}, TipPath{{Point(1.4, 0.85)}}, {true, bent_first}, {true, bent_last});
  ASSERT_GE(path.points.size(), 6u);
  EXPECT_EQ(path.points[0], kinked[0]);
  EXPECT_EQ(path.points[1], bent_first);
  EXPECT_NEAR(path.arc[1], 0.25 * first.measure, rounding);
  const std::size_t n = path.points.size();
  EXPECT_EQ(path.points[n - 3], bent_last);
  EXPECT_NEAR(path.arc[n - 3], path.length - 0.25 * last.measure, rounding);
  EXPECT_NEAR(path.arc[n - 2], path.length, rounding);
  EXPECT_NEAR(path.length, 1, rounding);
}

/// A cell that growth lays anew in each trial begins at a point of the path whether or not it bends there: the mesh of
/// the fine level does not change where the bend passes zero.
TEST(FracturePath, HasTheEndsOfACellThatTurnsHoweverSmallItsBend) {
  for (const double bend : {0.0, 1e-7, 0.9e-5, 1.1e-5, 1e-3}) {
    const Point first(0.5, 0.5 + 0.1 * bend), last(1.1, 0.5 - 0.1 * bend);
    const Mesh mesh = rock_with({{first, Point(0.6, 0.5), Point(1, 0.5), last}});
    const Fracture& cells = mesh.fractures[0];
    const auto end_of = [&](int cell, int end) {
      return mesh.ridges[mesh.fracture_cells[cells.first_cell + cell].ridges[end]].center;
    };
    const FracturePath path = fracture_path(mesh, 0, {}, TipPath{{Point(1.2, 0.5 - 0.2 * bend)}}, {true}, {true});
    const int n = cells.cell_count;
    const std::vector<Point> kept{first, end_of(0, 1), end_of(n - 1, 0), last, Point(1.2, 0.5 - 0.2 * bend)};
    for (const Point& x : kept)
      EXPECT_EQ(std::ranges::count_if(path.points, [&](const Point& y) { return (x - y).norm() < 1e-12; }), 1) << bend;
  }
}

TEST(FracturePath, KnowsEndsOnTheOuterBoundary) {
  const Mesh mesh = rock_with({{Point(0, 0.4), Point(0.5, 0.5)}, {Point(1.5, 0.4), Point(2, 0.5)}});
  const auto paths = paths_of(mesh);
  EXPECT_FALSE(paths[0].first_is_tip);
  EXPECT_TRUE(paths[0].last_is_tip);
  EXPECT_TRUE(paths[1].first_is_tip);
  EXPECT_FALSE(paths[1].last_is_tip);
}

TEST(FracturePath, HasAPointWhereAnotherFractureCrossesOrTouchesIt) {
  const Mesh mesh = rock_with(
      {{Point(0.4, 0.5), Point(1.6, 0.5)}, {Point(0.8, 0.2), Point(0.8, 0.8)}, {Point(1.2, 0.5), Point(1.3, 0.9)}});
  const auto paths = paths_of(mesh);
  expect_points(paths[0].points, {Point(0.4, 0.5), Point(0.8, 0.5), Point(1.2, 0.5), Point(1.6, 0.5)});
  expect_lengths(paths[0].arc, {0, 0.4, 0.8, 1.2});
  expect_points(paths[1].points, {Point(0.8, 0.2), Point(0.8, 0.5), Point(0.8, 0.8)});
  // The end that touches is no tip.
  expect_points(paths[2].points, {Point(1.2, 0.5), Point(1.3, 0.9)});
  EXPECT_FALSE(paths[2].first_is_tip);
  EXPECT_TRUE(paths[2].last_is_tip);
  EXPECT_TRUE(paths[0].first_is_tip && paths[0].last_is_tip);
}

}  // namespace
}  // namespace sprekk::test
