#include "framework/report/fracture_path.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sprekk {
namespace {

using testing::DoubleEq;
using testing::ElementsAre;

Grid lines(std::vector<std::array<double, 2>> points, std::vector<int> cells) {
  Grid grid;
  grid.points = std::move(points);
  grid.cells = std::move(cells);
  grid.points_per_cell = 2;
  return grid;
}

TEST(FracturePaths, follow_cells_that_are_out_of_order) {
  // From x = 0 over 1 and 3 to 6, with cells in both directions.
  const Grid grid = lines({{6, 0}, {3, 0}, {0, 0}, {1, 0}}, {1, 3, 0, 1, 2, 3});
  std::optional<PathOrigin> origin;
  const auto paths = fracture_paths(grid, {0, 1, 2}, origin);
  ASSERT_EQ(paths.size(), 1U);
  EXPECT_THAT(paths[0].cells, ElementsAre(2, 0, 1));
  EXPECT_THAT(paths[0].length, ElementsAre(DoubleEq(0.5), DoubleEq(2), DoubleEq(4.5)));
  EXPECT_DOUBLE_EQ(paths[0].end, 6);
}

TEST(FracturePaths, keep_their_origin_when_the_line_grows_at_both_ends) {
  std::optional<PathOrigin> origin;
  fracture_paths(lines({{0, 0}, {1, 0}}, {0, 1}), {0}, origin);
  // Grown by 0.5 at the first end and by 2 at the last one; the cells now begin at the last one.
  const Grid grown = lines({{3, 0}, {1, 0}, {0, 0}, {0, 0.5}}, {0, 1, 1, 2, 2, 3});
  const auto paths = fracture_paths(grown, {0, 1, 2}, origin);
  ASSERT_EQ(paths.size(), 1U);
  EXPECT_DOUBLE_EQ(paths[0].start, -0.5);
  EXPECT_DOUBLE_EQ(paths[0].end, 3);
  EXPECT_THAT(paths[0].cells, ElementsAre(2, 1, 0));
  EXPECT_THAT(paths[0].length, ElementsAre(DoubleEq(-0.25), DoubleEq(0.5), DoubleEq(2)));
}

TEST(FracturePaths, of_pieces_and_rings_hold_every_cell_once) {
  // A closed triangle, and a line apart from it.
  const Grid grid = lines({{0, 0}, {1, 0}, {0, 1}, {5, 5}, {6, 5}}, {0, 1, 1, 2, 2, 0, 3, 4});
  std::optional<PathOrigin> origin;
  std::vector<int> cells;
  for (const FracturePath& path : fracture_paths(grid, {0, 1, 2, 3}, origin)) {
    EXPECT_EQ(path.points.size(), path.cells.size() + 1);
    cells.insert(cells.end(), path.cells.begin(), path.cells.end());
  }
  EXPECT_THAT(cells, testing::UnorderedElementsAre(0, 1, 2, 3));
}

}  // namespace
}  // namespace sprekk
