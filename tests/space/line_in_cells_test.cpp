// A polyline through tetrahedra: its pieces join to it, and each lies in its cell; also far from the origin.
#include "framework/mesh/search/line_in_cells.hpp"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "framework/mesh/build_mesh.hpp"
#include "framework/mesh/search/point_location.hpp"
#include "tests/space/box_mesh.hpp"

namespace sprekk::test {
namespace {

const std::vector<Point> line = {Point(0.31, 0.42, 0.23), Point(1.7, 2.1, 1.3), Point(3.6, 2.5, 4.7)};

Mesh tetrahedra(const Point& shift) {
  BoxMesh box({4, 3, 5}, Bodies::tetrahedra);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> by(-0.1, 0.1);
  box.move_free_nodes([&] { return Point(by(random), by(random), by(random)); });
  for (Point& node : box.raw.nodes) node += shift;
  return build_mesh(box.raw);
}

TEST(LineInCells, PiecesJoinToTheLineAndLieInTheirCells) {
  std::vector<int> cells_near;
  // 5e5 m: coordinates of a survey; 1e-10 m is their round-off.
  for (const Point& shift : {Point(0, 0, 0), Point(5e5, -4e5, 2e3)}) {
    const Mesh mesh = tetrahedra(shift);
    const double within = 1e-9 * (1 + shift.norm());
    std::vector<Point> moved = line;
    for (Point& point : moved) point += shift;
    const PointLocation location(mesh);
    double length = 0;
    std::vector<int> cells;
    Point at = moved.front();
    for (const auto& [cell, from, to] : line_in_cells(mesh, moved)) {
      EXPECT_LT((from - at).norm(), within);
      EXPECT_EQ(location.cell_at(0.5 * (from + to)), cell);
      at = to;
      length += (to - from).norm();
      cells.push_back(cell);
    }
    EXPECT_LT((at - moved.back()).norm(), within);
    EXPECT_NEAR(length, (line[1] - line[0]).norm() + (line[2] - line[1]).norm(), within);
    EXPECT_GT(cells.size(), 15u);
    if (cells_near.empty()) cells_near = cells;
    EXPECT_EQ(cells, cells_near);
  }
}

TEST(LineInCells, RefuseLinesThatLeaveTheMesh) {
  EXPECT_THROW(line_in_cells(tetrahedra(Point::Zero()), {line[0], Point(1, 1, 7)}), std::invalid_argument);
}

}  // namespace
}  // namespace sprekk::test
