#include "framework/results/grid.hpp"

#include <gtest/gtest.h>

#include "framework/mesh/build_mesh.hpp"
#include "framework/output/vtu_writer.hpp"

namespace sprekk {
namespace {

TEST(ReadGrid, MakesTwoTrianglesOfAQuadrilateral) {
  const RawMesh raw{.nodes = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0.5}},
                    .cells = {{0, 1, 2, 3}, {1, 4, 2}},
                    .regions = {0, 0},
                    .region_names = {"rock"},
                    .boundary_faces = {{{0, 1}, 0}, {{2, 3}, 0}, {{3, 0}, 0}, {{1, 4}, 0}, {{4, 2}, 0}},
                    .side_names = {"outside"},
                    .fractures = {}};
  const Mesh mesh = build_mesh(raw);
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "sprekk_read_grid.vtu";
  const Vector pressure = Eigen::Vector2d(3, 5), velocity = Eigen::Vector4d(1, 2, 3, 4);
  const Vector head = Eigen::VectorXd::LinSpaced(5, 10, 14);
  write_matrix_vtu(file, mesh,
                   {{"pressure", "Pa", Location::cell, 1, pressure},
                    {"velocity", "m/s", Location::cell, 2, velocity},
                    {"head", "m", Location::node, 1, head}});
  const Grid grid = read_grid(file);
  std::filesystem::remove(file);
  EXPECT_EQ(grid.points_per_cell, 3);
  EXPECT_EQ(grid.cells, (std::vector{0, 1, 2, 0, 2, 3, 1, 4, 2}));
  EXPECT_EQ(grid.sources, (std::vector{0, 0, 1}));
  EXPECT_EQ(grid.find("pressure[Pa]")->values, (std::vector<double>{3, 3, 5}));
  EXPECT_EQ(grid.find("velocity[m/s]")->values, (std::vector<double>{1, 2, 0, 1, 2, 0, 3, 4, 0}));
  EXPECT_EQ(grid.find("head[m]")->values, (std::vector<double>{10, 11, 12, 13, 14}));
}

}  // namespace
}  // namespace sprekk
