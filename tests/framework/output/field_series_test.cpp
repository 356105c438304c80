#include "framework/output/field_series.hpp"

#include "framework/module/module.hpp"
#include "framework/output/vtk_module/vtk_module.hpp"
#include "tests/framework/output/small_case.hpp"

namespace sprekk {
namespace {

class FieldSeriesTest : public TemporaryFolder {
 protected:
  bool has(const std::string& name) const { return std::filesystem::exists(folder / name); }
};

TEST_F(FieldSeriesTest, NamesFilesByStepAndKeepsTheIndices) {
  const Mesh mesh = small_mesh();
  const OutputField pressure{"pore.pressure", "Pa", Location::cell, 1, Vector::Ones(mesh.cell_count())};
  FieldSeries output(folder);
  output.write(0, 0, mesh, {pressure});
  output.write(2.5, 10, mesh, {pressure});
  EXPECT_TRUE(has("matrix_000000.vtu"));
  EXPECT_TRUE(has("matrix_000010.vtu"));
  EXPECT_TRUE(has("fractures_000010.vtu"));
  const auto entries = TimeSeries::continued(folder / "fractures.pvd", 1e9).entries();
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[1].time, 2.5);
  EXPECT_EQ(entries[1].file, "fractures_000010.vtu");

  FieldSeries::continued(folder, 0).write(1, 7, mesh, {pressure});
  const auto after_restart = TimeSeries::continued(folder / "matrix.pvd", 1e9).entries();
  ASSERT_EQ(after_restart.size(), 2u);
  EXPECT_EQ(after_restart[1].file, "matrix_000007.vtu");
}

TEST_F(FieldSeriesTest, LinesBeyondTheMeshHaveFilesFromTheFirstOneOn) {
  const Mesh mesh = small_mesh();
  FieldSeries output(folder);
  output.write(0, 0, mesh, {});
  EXPECT_FALSE(has("paths.pvd"));
  output.write(1, 5, mesh, {}, {{0, {Point(1, 2), Point(3, 4), Point(3, 5)}}, {1, {Point(7, 7), Point(8, 7)}}});
  output.write(2, 6, mesh, {});
  const auto entries = TimeSeries::continued(folder / "paths.pvd", 1e9).entries();
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[0].file, "paths_000005.vtu");
  EXPECT_EQ(entries[1].time, 2);
  const GridData lines = module<VtkModule>("vtk").read(folder / "paths_000005.vtu");
  EXPECT_EQ(lines.cell_points, (std::vector<std::int64_t>{0, 1, 1, 2, 3, 4}));
  EXPECT_EQ(lines.cell_ends, (std::vector<std::int64_t>{2, 4, 6}));
  EXPECT_EQ(lines.points, (std::vector<double>{1, 2, 0, 3, 4, 0, 3, 5, 0, 7, 7, 0, 8, 7, 0}));
  ASSERT_EQ(lines.on_cells.size(), 1u);
  EXPECT_EQ(lines.on_cells[0].name, "fracture");
  EXPECT_EQ(lines.on_cells[0].values, (std::vector<double>{0, 0, 1}));
  EXPECT_EQ(module<VtkModule>("vtk").read(folder / "paths_000006.vtu").cell_count(), 0);
  // A run that continues from before the first written time has no entries yet.
  FieldSeries::continued(folder, 0.5).write(1, 4, mesh, {});
  EXPECT_FALSE(has("paths_000004.vtu"));
}

TEST_F(FieldSeriesTest, WithoutFracturesThereAreNoFractureFiles) {
  Geometry geometry;
  geometry.box.high = Point(1, 1);
  MeshOptions options;
  options.kind = MeshOptions::Kind::structured;
  options.cells = {2, 2};
  FieldSeries(folder).write(0, 0, build_mesh(structured_mesh(geometry, options)), {});
  EXPECT_TRUE(has("matrix_000000.vtu"));
  EXPECT_FALSE(has("fractures_000000.vtu"));
  EXPECT_FALSE(has("fractures.pvd"));
}

}  // namespace
}  // namespace sprekk
