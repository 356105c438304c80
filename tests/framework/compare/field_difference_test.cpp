#include "framework/compare/field_difference.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/framework/compare/grids.hpp"

namespace sprekk {
namespace {

using testing::DoubleEq;
using testing::DoubleNear;
using testing::Lt;

TEST(FieldDifference, of_a_planted_value_on_one_mesh_has_its_size_place_and_norm) {
  for (const double angle : {0.0, 0.6}) {
    Grid one = square(8, angle, 0.2);
    add_on_cells(one, "p[Pa]", [](double x, double y) { return 5e6 + 1e5 * (x + 2 * y); });
    Grid other = one;
    other.arrays[0].values[37] += 0.25;
    const GridDifference found = grid_difference(one, {}, other, {});
    EXPECT_TRUE(found.is_same_mesh);
    ASSERT_EQ(found.fields.size(), 1U);
    const FieldDifference& field = found.fields[0];
    EXPECT_THAT(field.largest, DoubleNear(0.25, 1e-8));
    const CellSampler cells(one, {});
    EXPECT_THAT(field.where[0], DoubleNear(cells.centre(37)[0], 1e-14));
    EXPECT_THAT(field.where[1], DoubleNear(cells.centre(37)[1], 1e-14));
    EXPECT_THAT(field.mean_square, DoubleNear(0.25 * std::sqrt(cells.size(37)), 1e-8));  // the square's area is 1
    const auto [low, high] = std::minmax_element(one.arrays[0].values.begin(), one.arrays[0].values.end());
    EXPECT_THAT(field.scale, DoubleNear(*high - *low, 1));
  }
}

TEST(FieldDifference, of_a_linear_field_on_two_meshes_is_round_off) {
  const Function linear = [](double x, double y) { return 3 - 2 * x + 7 * y; };
  for (const double angle : {0.0, 0.6})
    for (const bool is_first_finer : {false, true}) {
      Grid one = square(is_first_finer ? 13 : 6, angle, 0.2), other = square(is_first_finer ? 6 : 13, angle, 0.1);
      for (Grid* grid : {&one, &other}) {
        add_on_cells(*grid, "p[Pa]", linear);
        add_on_points(*grid, "u[m]", linear);
      }
      const GridDifference found = grid_difference(one, {}, other, {});
      EXPECT_FALSE(found.is_same_mesh);
      EXPECT_EQ(found.compared, 2 * 13 * 13);
      EXPECT_EQ(found.outside, 0);
      ASSERT_EQ(found.fields.size(), 2U);
      EXPECT_THAT(found.fields[0].mean_square, Lt(0.05));  // a corner triangle has one neighbour only
      EXPECT_THAT(found.fields[1].largest, Lt(1e-13));
    }
}

TEST(FieldDifference, of_a_smooth_field_on_two_meshes_falls_with_the_square_of_the_cells) {
  const Function smooth = [](double x, double y) { return std::sin(2 * x) * std::cos(3 * y); };
  std::vector<double> apart;
  for (const int n : {16, 32}) {
    Grid coarse = square(n, 0.3, 0.1), fine = square(2 * n, 0.3, 0.2);
    add_on_cells(coarse, "p[Pa]", smooth);
    add_on_cells(fine, "p[Pa]", smooth);
    apart.push_back(grid_difference(coarse, {}, fine, {}).fields[0].mean_square);
  }
  EXPECT_THAT(std::log2(apart[0] / apart[1]), testing::Gt(1.5));
  EXPECT_THAT(apart[1], Lt(2e-3));
}

TEST(FieldDifference, does_not_mix_values_across_walls) {
  // 1 below the diagonal of the square and 0 above it: whole numbers are not continued at all, so twice 0.5 is added.
  const Function step = [](double x, double y) { return x > y ? 1.25 + x : 0.5 - y; };
  Grid coarse = square(4, 0, 0), fine = square(8, 0, 0);
  add_on_cells(coarse, "p[Pa]", step);
  add_on_cells(fine, "p[Pa]", step);
  const Grid wall = line({{0, 0}, {0.25, 0.25}, {0.5, 0.5}, {0.75, 0.75}, {1, 1}});
  const GridDifference with = grid_difference(coarse, wall, fine, {}), without = grid_difference(coarse, {}, fine, {});
  EXPECT_THAT(with.fields[0].mean_square, Lt(without.fields[0].mean_square / 4));
  EXPECT_THAT(with.fields[0].mean_square, Lt(0.04));
}

TEST(FieldDifference, of_lines_is_taken_along_them) {
  const Function linear = [](double x, double y) { return 1 + 4 * x - y; };
  Grid coarse = line({{0, 0}, {0.4, 0.3}, {0.8, 0.6}, {1.6, 1.2}}),
       fine = line({{0, 0}, {0.2, 0.15}, {0.5, 0.375}, {0.9, 0.675}, {1.2, 0.9}, {1.6, 1.2}});
  add_on_cells(coarse, "w[m]", linear);
  add_on_cells(fine, "w[m]", linear);
  EXPECT_THAT(grid_difference(coarse, {}, fine, {}).fields[0].largest, Lt(1e-13));
  fine.arrays[1].values[2] += 1e-3;
  EXPECT_THAT(grid_difference(coarse, {}, fine, {}).fields[0].largest, DoubleNear(1e-3, 1e-12));
}

TEST(FieldDifference, leaves_out_what_one_mesh_does_not_cover) {
  Grid small = square(4, 0, 0), large = square(10, 0, 0);
  for (auto& point : large.points) point = {2 * point[0], point[1]};
  add_on_cells(small, "p[Pa]", [](double x, double) { return x; });
  add_on_cells(large, "p[Pa]", [](double x, double) { return x; });
  const GridDifference found = grid_difference(small, {}, large, {});
  EXPECT_EQ(found.outside, 100);
  EXPECT_EQ(found.compared, 100);
}

TEST(FieldDifference, of_a_value_that_one_mesh_alone_has_is_infinite) {
  Grid one = square(2, 0, 0);
  add_on_cells(one, "p[Pa]", [](double x, double) { return x; });
  Grid other = one;
  other.arrays[0].values[3] = std::nan("");
  EXPECT_TRUE(std::isinf(grid_difference(one, {}, other, {}).fields[0].largest));
  EXPECT_EQ(grid_difference(other, {}, other, {}).fields[0].largest, 0);
}

}  // namespace
}  // namespace sprekk
