// Meshes in space, written and read again.
#include <gtest/gtest.h>
#include <unistd.h>
#include <vtkCell.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <Eigen/Geometry>
#include <filesystem>

#include "framework/field/weights_in_cell.hpp"
#include "framework/mesh/build_mesh.hpp"
#include "framework/mesh/corner_weights.hpp"
#include "framework/module/module.hpp"
#include "framework/output/mesh_record.hpp"
#include "framework/output/vtk_module/vtk_module.hpp"
#include "framework/output/vtu_writer.hpp"
#include "tests/space/box_mesh.hpp"

namespace sprekk {
namespace {

using test::Bodies;
using test::BoxMesh;

class SpaceOutput : public testing::TestWithParam<Bodies> {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder); }
  void TearDown() override { std::filesystem::remove_all(folder); }

  static Mesh crossed_mesh(Bodies bodies) {
    BoxMesh box({4, 4, 4}, bodies);
    box.add_fracture({"first", 0, 2, {1, 1}, {3, 3}});
    box.add_fracture({"second", 1, 2, {1, 0}, {3, 3}});
    box.turn(Eigen::AngleAxisd(0.4, Point(3, 1, 2).normalized()));
    return build_mesh(box.raw);
  }

  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("sprekk_space_" + std::to_string(::getpid()));
  const Mesh mesh = crossed_mesh(GetParam());
};
INSTANTIATE_TEST_SUITE_P(Bodies, SpaceOutput,
                         testing::Values(Bodies::hexahedra, Bodies::wedges, Bodies::tetrahedra,
                                         Bodies::hexahedra_and_wedges));

Eigen::Vector3d corner(const GridData& grid, std::int64_t k) {
  return Eigen::Vector3d(grid.points.data() + 3 * grid.cell_points[static_cast<std::size_t>(k)]);
}

TEST_P(SpaceOutput, TheRecordComesBackToTheBit) {
  Hdf5Writer writer(folder / "mesh.h5");
  write_mesh(writer, mesh);
  writer.close();
  const Mesh read = read_mesh(Hdf5Reader(folder / "mesh.h5"));
  EXPECT_EQ(read.nodes, mesh.nodes);
  EXPECT_EQ(read.cell_nodes, mesh.cell_nodes);
  EXPECT_EQ(read.cell_faces, mesh.cell_faces);
  EXPECT_EQ(read.face_nodes, mesh.face_nodes);
  EXPECT_EQ(read.face_normal, mesh.face_normal);
  EXPECT_TRUE(is_same_mesh(read, mesh));
  ASSERT_EQ(read.ridges.size(), mesh.ridges.size());
  for (std::size_t i = 0; i < mesh.ridges.size(); ++i) {
    EXPECT_EQ(read.ridges[i].center, mesh.ridges[i].center);
    EXPECT_EQ(read.ridges[i].measure, mesh.ridges[i].measure);
    EXPECT_EQ(read.ridges[i].cells, mesh.ridges[i].cells);
    EXPECT_EQ(read.ridges[i].kind, mesh.ridges[i].kind);
    EXPECT_EQ(read.ridges[i].side, mesh.ridges[i].side);
  }
  ASSERT_EQ(read.junctions.size(), mesh.junctions.size());
  for (std::size_t i = 0; i < mesh.junctions.size(); ++i) EXPECT_EQ(read.junctions[i].ridges, mesh.junctions[i].ridges);
  for (int i = 0; i < mesh.fracture_cell_count(); ++i)
    EXPECT_EQ(read.fracture_cells[i].tangents, mesh.fracture_cells[i].tangents);
}

TEST_P(SpaceOutput, VtkHasTheBodiesAndTheirValues) {
  Vector centres(3 * mesh.cell_count()), heights(mesh.node_count());
  for (int c = 0; c < mesh.cell_count(); ++c) centres.segment<3>(3 * c) = mesh.cell_center[c];
  for (int n = 0; n < mesh.node_count(); ++n) heights[n] = mesh.nodes[n].z();
  write_matrix_vtu(
      folder / "matrix.vtu", mesh,
      {{"rock.centre", "m", Location::cell, 3, centres}, {"rock.height", "m", Location::node, 1, heights}});
  const GridData grid = module<VtkModule>("vtk").read(folder / "matrix.vtu");
  EXPECT_EQ(grid.cell_dimension, 3);
  ASSERT_EQ(grid.cell_count(), mesh.cell_count());
  ASSERT_EQ(grid.point_count(), mesh.node_count());
  std::int64_t begin = 0;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const std::int64_t end = grid.cell_ends[static_cast<std::size_t>(c)];
    ASSERT_EQ(end - begin, mesh.cell_nodes[c].size());
    for (int k = 0; k < mesh.cell_nodes[c].size(); ++k)
      ASSERT_EQ(corner(grid, begin + k), mesh.nodes[mesh.cell_nodes[c][k]]);
    begin = end;
  }
  ASSERT_EQ(grid.on_points.size(), 1U);
  EXPECT_EQ(grid.on_points[0].values, std::vector<double>(heights.begin(), heights.end()));
  EXPECT_EQ(grid.on_cells[1].values, std::vector<double>(centres.begin(), centres.end()));
}

TEST_P(SpaceOutput, VtkSeesFacesThatPointOut) {
  write_matrix_vtu(folder / "matrix.vtu", mesh, {});
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((folder / "matrix.vtu").c_str());
  reader->Update();
  vtkUnstructuredGrid& grid = *reader->GetOutput();
  ASSERT_EQ(grid.GetNumberOfCells(), mesh.cell_count());
  for (int c = 0; c < mesh.cell_count(); ++c) {
    vtkCell& cell = *grid.GetCell(c);
    ASSERT_EQ(cell.GetNumberOfFaces(), mesh.cell_faces[c].size());
    double volume = 0;  // by the divergence theorem, from faces as VTK has them
    for (int k = 0; k < cell.GetNumberOfFaces(); ++k) {
      vtkPoints& face = *cell.GetFace(k)->GetPoints();
      const auto at = [&](int j) { return Eigen::Vector3d(face.GetPoint(j)); };
      for (int j = 1; j + 1 < face.GetNumberOfPoints(); ++j)
        volume += (at(0) - mesh.cell_center[c]).dot((at(j) - at(0)).cross(at(j + 1) - at(0))) / 6;
    }
    ASSERT_NEAR(volume, mesh.cell_measure[c], 1e-13);
  }
}

TEST_P(SpaceOutput, VtkHasTheFracturesWithTheirArea) {
  write_fracture_vtu(folder / "fracture.vtu", mesh, {});
  const GridData grid = module<VtkModule>("vtk").read(folder / "fracture.vtu");
  EXPECT_EQ(grid.cell_dimension, 2);
  ASSERT_EQ(grid.cell_count(), mesh.fracture_cell_count());
  std::int64_t begin = 0;
  for (int i = 0; i < mesh.fracture_cell_count(); ++i) {
    const std::int64_t end = grid.cell_ends[static_cast<std::size_t>(i)];
    Eigen::Vector3d area = Eigen::Vector3d::Zero();
    for (std::int64_t k = begin + 1; k + 1 < end; ++k)
      area += 0.5 * (corner(grid, k) - corner(grid, begin)).cross(corner(grid, k + 1) - corner(grid, begin));
    const FractureCell& cell = mesh.fracture_cells[i];
    ASSERT_LT((area - cell.measure * cell.normal).norm(), 1e-14);
    begin = end;
  }
}

TEST_P(SpaceOutput, ValuesWithinCellsAreExactForLinearFunctions) {
  const Point slope(0.3, -1.2, 2.1);
  for (int c = 0; c < mesh.cell_count(); ++c) {
    Point inside = Point::Zero();
    double sum = 0, share = 1;
    for (const int node : mesh.cell_nodes[c]) {
      share *= 1.3;  // unlike for each
      inside += share * mesh.nodes[node];
      sum += share;
    }
    inside /= sum;
    for (const Location location : {Location::node, Location::face}) {
      double value = 0, all = 0;
      for (const auto& [entity, weight] : weights_in_cell(mesh, location, c, inside)) {
        const Point at = location == Location::node ? mesh.nodes[entity] : mesh.face_center[entity];
        value += weight * slope.dot(at);
        all += weight;
        EXPECT_TRUE(location == Location::face || weight > 0);
      }
      EXPECT_NEAR(value, slope.dot(inside), 1e-12);
      EXPECT_NEAR(all, 1, 1e-12);
    }
  }
}

}  // namespace
}  // namespace sprekk
