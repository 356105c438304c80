#include "framework/output/field_output.hpp"

#include "tests/framework/output/small_case.hpp"

namespace sprekk {
namespace {

class FieldOutputTest : public TemporaryFolder {
 protected:
  bool has(const std::string& name) const { return std::filesystem::exists(folder / name); }
};

TEST_F(FieldOutputTest, NamesFilesByStepAndKeepsTheIndices) {
  const Mesh mesh = small_mesh();
  const OutputField pressure{"pore.pressure", "Pa", Location::cell, 1, Vector::Ones(mesh.cell_count())};
  FieldOutput output(folder);
  output.write(0, 0, mesh, {pressure});
  output.write(2.5, 10, mesh, {pressure});
  EXPECT_TRUE(has("matrix_000000.vtu"));
  EXPECT_TRUE(has("matrix_000010.vtu"));
  EXPECT_TRUE(has("fractures_000010.vtu"));
  const auto entries = TimeSeries::continued(folder / "fractures.pvd", 1e9).entries();
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[1].time, 2.5);
  EXPECT_EQ(entries[1].file, "fractures_000010.vtu");

  FieldOutput::continued(folder, 0).write(1, 7, mesh, {pressure});
  const auto after_restart = TimeSeries::continued(folder / "matrix.pvd", 1e9).entries();
  ASSERT_EQ(after_restart.size(), 2u);
  EXPECT_EQ(after_restart[1].file, "matrix_000007.vtu");
}

TEST_F(FieldOutputTest, WithoutFracturesThereAreNoFractureFiles) {
  Geometry geometry;
  geometry.box.high = Point(1, 1);
  MeshOptions options;
  options.kind = MeshOptions::Kind::structured;
  options.cells = {2, 2};
  FieldOutput(folder).write(0, 0, build_mesh(structured_mesh(geometry, options)), {});
  EXPECT_TRUE(has("matrix_000000.vtu"));
  EXPECT_FALSE(has("fractures_000000.vtu"));
  EXPECT_FALSE(has("fractures.pvd"));
}

}  // namespace
}  // namespace sprekk
