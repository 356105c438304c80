// Fields in space on two meshes of one box.
#include "framework/compare/body_difference.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

#include "framework/results/bodies.hpp"

namespace sprekk {
namespace {

using testing::DoubleNear;
using testing::Lt;
using Function = std::function<double(const Eigen::Vector3d&)>;

enum class Shape { hexahedra, wedges, tetrahedra };

/// A box of 1 by 1.2 by 0.7 m of n^3 hexahedra, or of wedges or tetrahedra that divide them; inner nodes are moved, and
/// all is turned.
GridData box(Shape shape, int n, double angle, double moved) {
  GridData grid;
  grid.cell_dimension = 3;
  const Eigen::AngleAxisd turn(angle, Eigen::Vector3d(1, 2, 3).normalized());
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        Eigen::Vector3d x(i, j, k);
        if (i % n != 0 && j % n != 0 && k % n != 0)
          x += moved * Eigen::Vector3d(std::sin(7.0 * i + j), std::cos(3.0 * j + k), std::sin(5.0 * k + i));
        x = turn * x.cwiseProduct(Eigen::Vector3d(1, 1.2, 0.7) / n).eval();
        grid.points.insert(grid.points.end(), {x[0], x[1], x[2]});
      }
  const auto add = [&](const std::vector<std::int64_t>& nodes) {
    grid.cell_points.insert(grid.cell_points.end(), nodes.begin(), nodes.end());
    grid.cell_ends.push_back(static_cast<std::int64_t>(grid.cell_points.size()));
  };
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const auto at = [&](int a, int b, int c) -> std::int64_t {
          return ((k + c) * (n + 1) + j + b) * (n + 1) + i + a;
        };
        const std::array<std::int64_t, 8> x{at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0),
                                            at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)};
        if (shape == Shape::hexahedra) {
          add({x.begin(), x.end()});
        } else if (shape == Shape::wedges) {
          add({x[0], x[1], x[2], x[4], x[5], x[6]});
          add({x[0], x[2], x[3], x[4], x[6], x[7]});
        } else {  // Kuhn's six around the diagonal
          for (const auto& [a, b] : {std::pair{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}})
            add({x[0], x[a], x[b], x[6]});
        }
      }
  return grid;
}

void add_on_cells(GridData& grid, const Function& value) {
  const Bodies bodies(grid);
  GridData::Array array{"p[Pa]", 1, {}};
  for (int body = 0; body < bodies.count(); ++body) array.values.push_back(value(bodies.centre(body)));
  grid.on_cells.push_back(std::move(array));
}

double linear(const Eigen::Vector3d& x) { return 3 - 2 * x[0] + 7 * x[1] + 4 * x[2]; }

TEST(BodyDifference, OfAPlantedValueOnOneMeshHasItsSizePlaceAndNorm) {
  for (const Shape shape : {Shape::hexahedra, Shape::wedges, Shape::tetrahedra}) {
    GridData one = box(shape, 4, 0.6, 0.1);
    add_on_cells(one, linear);
    GridData other = one;
    other.on_cells[0].values[37] += 0.25;
    const GridDifference found = body_difference(one, other);
    EXPECT_TRUE(found.is_same_mesh);
    ASSERT_EQ(found.fields.size(), 1U);
    const Bodies bodies(one);
    double whole = 0;
    for (int body = 0; body < bodies.count(); ++body) whole += bodies.volume(body);
    EXPECT_THAT(whole, DoubleNear(0.84, 1e-12));
    EXPECT_THAT(found.fields[0].largest, DoubleNear(0.25, 1e-12));
    EXPECT_THAT(found.fields[0].mean_square, DoubleNear(0.25 * std::sqrt(bodies.volume(37) / whole), 1e-12));
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_THAT(found.fields[0].where[axis], DoubleNear(bodies.centre(37)[axis], 1e-14));
  }
}

TEST(BodyDifference, OfALinearFieldOnTwoMeshesIsRoundOff) {
  for (const double angle : {0.0, 0.6})
    for (const auto& [shape, n] : {std::pair{Shape::hexahedra, 7}, {Shape::wedges, 6}, {Shape::tetrahedra, 4}}) {
      GridData one = box(Shape::tetrahedra, 5, angle, 0.15), other = box(shape, n, angle, 0.1);
      add_on_cells(one, linear);
      add_on_cells(other, linear);
      for (const GridDifference& found : {body_difference(one, other), body_difference(other, one)}) {
        EXPECT_FALSE(found.is_same_mesh);
        EXPECT_EQ(found.compared, 6 * 125);
        EXPECT_EQ(found.outside, 0);
        ASSERT_EQ(found.fields.size(), 1U);
        EXPECT_THAT(found.fields[0].largest, Lt(1e-12));
      }
    }
}

TEST(BodyDifference, OfASmoothFieldFallsWithTheSquareOfTheCells) {
  std::vector<double> apart;
  for (const int n : {5, 10}) {
    GridData one = box(Shape::tetrahedra, n, 0.3, 0.1), other = box(Shape::hexahedra, 2 * n + 1, 0.3, 0.1);
    for (GridData* grid : {&one, &other})
      add_on_cells(*grid,
                   [](const Eigen::Vector3d& x) { return std::sin(2 * x[0]) * std::cos(3 * x[1]) + x[2] * x[2]; });
    apart.push_back(body_difference(one, other).fields.at(0).mean_square);
  }
  EXPECT_THAT(apart[1], Lt(0.35 * apart[0]));
}

// Two halves that share no nodes, as on both sides of a fracture: a step between them is no slope.
TEST(BodyDifference, DoesNotSmoothAStepAcrossAFracture) {
  const auto with_gap = [](int n) {
    GridData grid = box(Shape::hexahedra, n, 0, 0);
    const GridData half = grid;
    const auto points = static_cast<std::int64_t>(grid.points.size() / 3);
    for (std::size_t i = 0; i < half.points.size(); i += 3)
      grid.points.insert(grid.points.end(), {half.points[i] + 1, half.points[i + 1], half.points[i + 2]});
    for (const std::int64_t node : half.cell_points) grid.cell_points.push_back(node + points);
    for (const std::int64_t end : half.cell_ends)
      grid.cell_ends.push_back(end + static_cast<std::int64_t>(half.cell_points.size()));
    add_on_cells(grid, [](const Eigen::Vector3d& x) { return x[0] < 1 ? linear(x) : 100 - linear(x); });
    return grid;
  };
  EXPECT_THAT(body_difference(with_gap(4), with_gap(7)).fields.at(0).largest, Lt(1e-12));
}

}  // namespace
}  // namespace sprekk
