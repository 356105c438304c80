#include "framework/remeshing/free_length.hpp"

#include <cmath>
#include <stdexcept>

#include "tests/framework/remeshing/mesh_with_obstacles.hpp"

namespace sprekk::test {
namespace {

TEST(FreeLength, IsTheWayToTheNearestObstacle) {
  const Mesh mesh = mesh_with_obstacles(0.1);
  FreeLength free = free_length(mesh, 0, true, {1.5, 1}, {2, 0});
  EXPECT_EQ(free.met, FreeLength::Met::fracture);
  EXPECT_EQ(free.index, 1);
  EXPECT_NEAR(free.length, 1, 1e-14);
  EXPECT_NEAR((free.where - Point(2.5, 1)).norm(), 0, 1e-14);
  free = free_length(mesh, 0, true, {1.5, 1}, {1, 1});
  EXPECT_EQ(free.met, FreeLength::Met::boundary);
  EXPECT_EQ(mesh.side_names[free.index], "top");
  EXPECT_NEAR(free.length, std::sqrt(2.0), 1e-14);
  free = free_length(mesh, 0, false, {0.5, 0.5}, {-3, -4});
  EXPECT_EQ(mesh.side_names[free.index], "bottom");
  EXPECT_NEAR(free.length, 0.625, 1e-14);
  // Through a node of the wall, and to the end of a fracture in line.
  free =
      free_length(mesh, 0, true, {1.5, 1},
                  mesh.ridges[mesh.fracture_cells[mesh.fractures[1].first_cell + 3].ridges[0]].center - Point(1.5, 1));
  EXPECT_EQ(free.index, 1);
  EXPECT_EQ(free.met, FreeLength::Met::fracture);
  free = free_length(mesh, 0, true, {2.7, 1}, {1, 0});
  EXPECT_EQ(free.index, 2);
  EXPECT_NEAR(free.length, 0.3, 1e-12);
  // Backwards it is the fracture itself that is met, behind its last cell.
  free = free_length(mesh, 0, true, {1.5, 1.1}, {-1, -1});
  EXPECT_EQ(free.met, FreeLength::Met::fracture);
  EXPECT_EQ(free.index, 0);
  EXPECT_EQ(free_length(mesh, 0, true, {5, 5}, {1, 1}).met, FreeLength::Met::nothing);
  EXPECT_THROW(free_length(mesh, 0, true, {1, 1}, {0, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace sprekk::test
