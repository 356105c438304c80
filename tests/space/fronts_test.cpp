// The lines along which fractures end in the rock.
#include "framework/mesh/space/fronts.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <filesystem>

#include "framework/mesh/build_mesh.hpp"
#include "framework/module/module.hpp"
#include "framework/output/vtk_module/vtk_module.hpp"
#include "framework/output/vtu_writer.hpp"
#include "tests/space/box_mesh.hpp"

namespace sprekk {
namespace {

using test::Bodies;
using test::BoxMesh;

class Fronts : public testing::TestWithParam<Bodies> {
 protected:
  /// One fracture ends in the rock all around, one on a side.
  static Mesh box_with_fractures() {
    BoxMesh box({4, 4, 4}, GetParam());
    box.add_fracture({"inside", 0, 1, {1, 1}, {3, 3}});
    box.add_fracture({"outward", 0, 3, {1, 0}, {3, 3}});
    box.turn(Eigen::AngleAxisd(0.4, Point(3, 1, 2).normalized()));
    return build_mesh(box.raw);
  }
};
INSTANTIATE_TEST_SUITE_P(Bodies, Fronts, testing::Values(Bodies::hexahedra, Bodies::wedges, Bodies::tetrahedra));

TEST_P(Fronts, GoClockwiseAroundTheirFracturesAsSeenFromThePlusSide) {
  const Mesh mesh = box_with_fractures();
  const std::vector<FrontLine> found = fronts(mesh);
  ASSERT_EQ(found.size(), 2U);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(found[i].fracture, i);
    EXPECT_EQ(found[i].is_closed, i == 0);
    const int count = static_cast<int>(found[i].edges.size());
    EXPECT_EQ(count, 8);  // of 2 x 2 cells all around; of 2 x 3 cells but for the two on the side
    Point area = Point::Zero();
    for (int k = 0; k < count; ++k) {
      const RimEdge& edge = found[i].edges[k];
      if (k + 1 < count || i == 0) {
        EXPECT_EQ(edge.nodes[1], found[i].edges[(k + 1) % count].nodes[0]);
      }
      EXPECT_EQ(mesh.ridges[found[i].ridges[k]].kind, Ridge::Kind::tip);
      const Point middle = (mesh.nodes[edge.nodes[0]] + mesh.nodes[edge.nodes[1]]) / 2;
      EXPECT_LT((middle - mesh.ridges[found[i].ridges[k]].center).norm(), 1e-14);
      area += mesh.nodes[edge.nodes[0]].cross(mesh.nodes[edge.nodes[1]]) / 2;
    }
    // The normal points away from the viewer on the plus side.
    if (i == 0) {
      EXPECT_NEAR(area.dot(mesh.fracture_cells[mesh.fractures[0].first_cell].normal), 4, 1e-12);
    }
  }
}

TEST_P(Fronts, AreWrittenInTheirOrderWithFieldsOnRidges) {
  const Mesh mesh = box_with_fractures();
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("sprekk_fronts_" + std::to_string(::getpid()) + ".vtu");
  OutputField field{"tips.height", "m", Location::ridge, 1, Vector(std::ssize(mesh.ridges))};
  for (std::size_t i = 0; i < mesh.ridges.size(); ++i) field.values[i] = mesh.ridges[i].center.z();
  write_front_vtu(file, mesh, {field});
  const GridData grid = module<VtkModule>("vtk").read(file);
  std::filesystem::remove(file);
  ASSERT_EQ(grid.cell_count(), 16);
  EXPECT_EQ(grid.point_count(), 8 + 9);
  ASSERT_EQ(grid.on_cells.size(), 2U);
  for (int c = 0; c < grid.cell_count(); ++c) {
    EXPECT_EQ(grid.on_cells[0].values[c], c < 8 ? 0 : 1);
    double height = 0;
    for (int k = 0; k < 2; ++k) height += grid.points[3 * grid.cell_points[2 * c + k] + 2] / 2;
    EXPECT_NEAR(grid.on_cells[1].values[c], height, 1e-14);
  }
}

}  // namespace
}  // namespace sprekk
