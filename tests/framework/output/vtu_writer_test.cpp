#include "framework/output/vtu_writer.hpp"

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <bit>
#include <cstdint>
#include <limits>

#include "framework/mesh/build_mesh.hpp"
#include "tests/framework/output/small_case.hpp"

namespace sprekk {
namespace {

class VtuWriter : public TemporaryFolder {
 protected:
  vtkUnstructuredGrid* read(const std::filesystem::path& file) {
    reader->SetFileName(file.c_str());
    reader->Update();
    EXPECT_EQ(reader->GetErrorCode(), 0u);
    return reader->GetOutput();
  }

  Mesh mesh = small_mesh();
  vtkNew<vtkXMLUnstructuredGridReader> reader;
};

/// Values with all their bits in use, different for every entry.
OutputField field_on(const Mesh& mesh, const std::string& name, Location location, int components) {
  Vector values(entity_count(mesh, location) * components);
  for (Eigen::Index i = 0; i < values.size(); ++i) values[i] = 1e6 / (3.0 + static_cast<double>(i));
  return {name, "Pa", location, components, values};
}

void expect_values(vtkDataArray* array, const OutputField& field, int first = 0, int stride = 1) {
  ASSERT_NE(array, nullptr);
  ASSERT_EQ(array->GetNumberOfTuples() * stride * field.components, field.values.size());
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    for (int c = 0; c < field.components; ++c)
      EXPECT_EQ(array->GetComponent(i, c), field.values[(i * stride + first) * field.components + c]);
}

TEST_F(VtuWriter, MatrixIsReadBackToTheBit) {
  const auto pressure = field_on(mesh, "pore.pressure", Location::cell, 1);
  const auto displacement = field_on(mesh, "rock.displacement", Location::node, 2);
  const auto stress = field_on(mesh, "rock.stress", Location::cell, 3);
  const auto aperture = field_on(mesh, "conduit.aperture", Location::fracture_cell, 1);
  OutputField flux = field_on(mesh, "pore.flux", Location::face, 1);  // 2 x − y, so that means are those of the middle
  for (int f = 0; f < mesh.face_count(); ++f) flux.values[f] = Point(2, -1).dot(mesh.face_center[f]);
  write_matrix_vtu(folder / "m.vtu", mesh, {pressure, displacement, stress, aperture, flux});

  vtkUnstructuredGrid* grid = read(folder / "m.vtu");
  ASSERT_EQ(grid->GetNumberOfPoints(), mesh.node_count());
  ASSERT_EQ(grid->GetNumberOfCells(), mesh.cell_count());
  for (int i = 0; i < mesh.node_count(); ++i) {
    EXPECT_EQ(grid->GetPoint(i)[0], mesh.nodes[i].x());
    EXPECT_EQ(grid->GetPoint(i)[1], mesh.nodes[i].y());
    EXPECT_EQ(grid->GetPoint(i)[2], 0);
  }
  for (int i = 0; i < mesh.cell_count(); ++i) {
    vtkIdType count;
    const vtkIdType* points;
    grid->GetCellPoints(i, count, points);
    ASSERT_EQ(count, 3);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(points[k], mesh.cell_nodes[i][k]);
  }
  expect_values(grid->GetCellData()->GetArray("pore.pressure[Pa]"), pressure);
  expect_values(grid->GetPointData()->GetArray("rock.displacement[Pa]"), displacement);
  EXPECT_EQ(grid->GetPointData()->GetArray("rock.displacement[Pa]")->GetNumberOfComponents(), 3);
  EXPECT_EQ(grid->GetPointData()->GetArray("rock.displacement[Pa]")->GetComponent(7, 2), 0);
  expect_values(grid->GetCellData()->GetArray("rock.stress[Pa]"), stress);
  vtkDataArray* means = grid->GetCellData()->GetArray("pore.flux[Pa]");
  ASSERT_NE(means, nullptr);
  for (int c = 0; c < mesh.cell_count(); ++c)
    EXPECT_NEAR(means->GetComponent(c, 0), Point(2, -1).dot(mesh.cell_center[c]), 1e-13);
  EXPECT_EQ(grid->GetCellData()->GetArray("conduit.aperture[Pa]"), nullptr);
  EXPECT_NE(grid->GetCellData()->GetArray("region"), nullptr);
}

TEST_F(VtuWriter, TrianglesBesideQuadrilateralsAreReadBack) {
  RawMesh raw{.nodes = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0.5}},
              .cells = {{0, 1, 2, 3}, {1, 4, 2}},
              .regions = {0, 1},
              .region_names = {"rock", "other"},
              .boundary_faces = {{{0, 1}, 0}, {{2, 3}, 0}, {{3, 0}, 0}, {{1, 4}, 0}, {{4, 2}, 0}},
              .side_names = {"outside"},
              .fractures = {}};
  const Mesh mixed = build_mesh(raw);
  const auto pressure = field_on(mixed, "pore.pressure", Location::cell, 1);
  write_matrix_vtu(folder / "mixed.vtu", mixed, {pressure});
  vtkUnstructuredGrid* grid = read(folder / "mixed.vtu");
  ASSERT_EQ(grid->GetNumberOfCells(), 2);
  EXPECT_EQ(grid->GetCellType(0), VTK_QUAD);
  EXPECT_EQ(grid->GetCellType(1), VTK_TRIANGLE);
  for (int i = 0; i < 2; ++i) {
    vtkIdType count;
    const vtkIdType* points;
    grid->GetCellPoints(i, count, points);
    EXPECT_EQ(std::vector<int>(points, points + count),
              std::vector<int>(mixed.cell_nodes[i].begin(), mixed.cell_nodes[i].end()));
  }
  expect_values(grid->GetCellData()->GetArray("pore.pressure[Pa]"), pressure);
}

TEST_F(VtuWriter, FracturesAreReadBackToTheBitWithTheirWallsAndFrames) {
  const auto slip = field_on(mesh, "contact.slip", Location::fracture_cell, 1);
  const auto walls = field_on(mesh, "rock.wall_displacement", Location::wall, 2);
  const auto pressure = field_on(mesh, "pore.pressure", Location::cell, 1);
  const auto jump = field_on(mesh, "contact.jump", Location::fracture_cell, 2);
  write_fracture_vtu(folder / "f.vtu", mesh, {slip, walls, pressure, jump});

  vtkUnstructuredGrid* grid = read(folder / "f.vtu");
  ASSERT_EQ(grid->GetNumberOfCells(), 4);  // three cells of a quarter each, and one
  for (int i = 0; i < 4; ++i) {
    vtkIdType count;
    const vtkIdType* points;
    grid->GetCellPoints(i, count, points);
    ASSERT_EQ(count, 2);
    const Point& begin = mesh.ridges[mesh.fracture_cells[i].ridges[0]].center;
    EXPECT_EQ(grid->GetPoint(points[0])[0], begin.x());
    EXPECT_EQ(grid->GetPoint(points[0])[1], begin.y());
    EXPECT_EQ(grid->GetCellData()->GetArray("fracture")->GetComponent(i, 0), i < 3 ? 0 : 1);
  }
  expect_values(grid->GetCellData()->GetArray("contact.slip[Pa]"), slip);
  vtkDataArray* normal = grid->GetCellData()->GetArray("contact.jump.normal[Pa]");
  vtkDataArray* tangential = grid->GetCellData()->GetArray("contact.jump.tangential[Pa]");
  ASSERT_NE(normal, nullptr);
  ASSERT_NE(tangential, nullptr);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(normal->GetComponent(i, 0), jump.values[2 * i]);
    EXPECT_EQ(tangential->GetComponent(i, 0), jump.values[2 * i + 1]);
  }
  expect_values(grid->GetCellData()->GetArray("rock.wall_displacement.plus[Pa]"), walls, 0, 2);
  expect_values(grid->GetCellData()->GetArray("rock.wall_displacement.minus[Pa]"), walls, 1, 2);
  EXPECT_EQ(grid->GetCellData()->GetArray("pore.pressure[Pa]"), nullptr);
}

TEST_F(VtuWriter, ValuesThatAreNoNumbersKeepTheirBitsAndNamesTheirCharacters) {
  OutputField field = field_on(mesh, "a & b < \"c\"", Location::cell, 1);
  const double special[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -0.0,
                            std::numeric_limits<double>::denorm_min()};
  for (int i = 0; i < 4; ++i) field.values[i] = special[i];
  write_matrix_vtu(folder / "m.vtu", mesh, {field});
  vtkDataArray* array = read(folder / "m.vtu")->GetCellData()->GetArray("a & b < \"c\"[Pa]");
  ASSERT_NE(array, nullptr);
  for (int i = 0; i < 4; ++i)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(array->GetComponent(i, 0)), std::bit_cast<std::uint64_t>(special[i]));
}

TEST_F(VtuWriter, RegionsAreIntegers) {
  write_matrix_vtu(folder / "m.vtu", mesh, {});
  EXPECT_EQ(read(folder / "m.vtu")->GetCellData()->GetArray("region")->GetDataType(), VTK_INT);
}

TEST_F(VtuWriter, AMeshWithoutFracturesGivesAnEmptyFractureGrid) {
  write_fracture_vtu(folder / "f.vtu", Mesh{}, {});
  EXPECT_EQ(read(folder / "f.vtu")->GetNumberOfCells(), 0);
}

TEST_F(VtuWriter, TheFieldOfARunIsWrittenAsItIsNow) {
  Field field({.owner = "pore",
               .name = "pressure",
               .location = Location::cell,
               .role = Role::unknown(BlockKind::interface),
               .unit = "Pa",
               .doc = ""},
              2);
  field.set_both(Vector::Constant(2, 1));
  field.set(Vector::Constant(2, 5));
  const OutputField out = output_field(field);
  EXPECT_EQ(out.name, "pore.pressure");
  EXPECT_EQ(out.unit, "Pa");
  EXPECT_EQ(out.values, Vector::Constant(2, 5));
}

TEST_F(VtuWriter, LabelsCarryTheUnit) {
  EXPECT_EQ(labelled("pore.pressure", "Pa"), "pore.pressure[Pa]");
  EXPECT_EQ(labelled("contact.state", ""), "contact.state[1]");
}

TEST_F(VtuWriter, AWrongSizeAndAnUnwritablePlaceAreErrors) {
  OutputField field = field_on(mesh, "pore.pressure", Location::cell, 1);
  EXPECT_THROW(write_matrix_vtu(folder / "missing" / "m.vtu", mesh, {field}), std::runtime_error);
  field.values.conservativeResize(3);
  EXPECT_THROW(write_matrix_vtu(folder / "m.vtu", mesh, {field}), std::logic_error);
}

/// Values at points are exact for a linear field, at corners, on sides and on both sides of fractures, too. A field
/// that jumps where a fracture lies has the value of its own side on each of the two nodes.
TEST_F(VtuWriter, PointsHaveTheValuesOfCells) {
  const auto linear = [](const Point& x) { return 2 * x.x() - x.y() + 3; };
  const auto is_above = [](const Point& x) { return x.y() > 0.5; };
  const auto field = [&](const char* name, int components, double jump) {
    Vector values(mesh.cell_count() * components);
    for (int c = 0; c < mesh.cell_count(); ++c)
      for (int k = 0; k < components; ++k)
        values[c * components + k] = (k + 1) * linear(mesh.cell_center[c]) + (is_above(mesh.cell_center[c]) ? jump : 0);
    return OutputField{name, "Pa", Location::cell, components, values};
  };
  write_matrix_vtu(folder / "p.vtu", mesh, {field("linear", 1, 0), field("pair", 2, 0), field("jump", 1, 10)},
                   PointData::of_cells_too);
  vtkUnstructuredGrid* grid = read(folder / "p.vtu");
  vtkDataArray* values = grid->GetPointData()->GetArray("linear[Pa]");
  vtkDataArray* pair = grid->GetPointData()->GetArray("pair[Pa]");
  vtkDataArray* jump = grid->GetPointData()->GetArray("jump[Pa]");
  ASSERT_TRUE(values && pair && jump);
  ASSERT_TRUE(grid->GetCellData()->GetArray("linear[Pa]"));
  ASSERT_EQ(pair->GetNumberOfComponents(), 3);
  int on_walls = 0;
  for (int i = 0; i < mesh.node_count(); ++i) {
    const double exact = linear(mesh.nodes[i]);
    EXPECT_NEAR(values->GetComponent(i, 0), exact, 1e-12) << i;
    EXPECT_NEAR(pair->GetComponent(i, 0), exact, 1e-12) << i;
    EXPECT_NEAR(pair->GetComponent(i, 1), 2 * exact, 1e-12) << i;
    const auto& cells = mesh.node_cells[i];
    const bool above = is_above(mesh.cell_center[*cells.begin()]);
    if (std::abs(mesh.nodes[i].y() - 0.5) > 1e-9 || mesh.nodes[i].x() > 0.7) continue;  // off "long", or its tip
    ++on_walls;
    EXPECT_NEAR(jump->GetComponent(i, 0), exact + (above ? 10 : 0), 1e-12) << i;
  }
  EXPECT_EQ(on_walls, 6);  // three places, twice
}

}  // namespace
}  // namespace sprekk
