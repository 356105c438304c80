#include "framework/output/vtu_writer.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <stdexcept>

#include "framework/output/atomic_file.hpp"

namespace sprekk {
namespace {

/// Every `stride`-th entity from `first` on; fields on walls interleave the two sides.
vtkSmartPointer<vtkDoubleArray> make_array(const OutputField& field, const std::string& name, int first = 0,
                                           int stride = 1) {
  const int components = field.components;
  const int written = components == dimension ? 3 : components;
  const int count = static_cast<int>(field.values.size()) / components / stride;
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(labelled(name, field.unit).c_str());
  array->SetNumberOfComponents(written);
  array->SetNumberOfTuples(count);
  double* out = array->GetPointer(0);
  for (int i = 0; i < count; ++i) {
    const double* in = field.values.data() + (i * stride + first) * components;
    for (int c = 0; c < written; ++c) *out++ = c < components ? in[c] : 0.0;
  }
  return array;
}

vtkSmartPointer<vtkIntArray> make_array(const std::string& name, int count) {
  auto array = vtkSmartPointer<vtkIntArray>::New();
  array->SetName(name.c_str());
  array->SetNumberOfValues(count);
  return array;
}

/// Two points make a line, three a triangle, four a quadrilateral.
template <class PointsOfCell>
void set_cells(vtkUnstructuredGrid& grid, int count, const PointsOfCell& points_of_cell) {
  vtkNew<vtkUnsignedCharArray> types;
  vtkNew<vtkIdTypeArray> connectivity, offsets;
  types->SetNumberOfValues(count);
  offsets->SetNumberOfValues(count + 1);
  vtkIdType next = 0;
  for (int i = 0; i < count; ++i) {
    offsets->SetValue(i, next);
    const auto& points = points_of_cell(i);
    types->SetValue(i, points.size() == 2 ? VTK_LINE : points.size() == 3 ? VTK_TRIANGLE : VTK_QUAD);
    next += static_cast<vtkIdType>(points.size());
  }
  offsets->SetValue(count, next);
  connectivity->SetNumberOfValues(next);
  next = 0;
  for (int i = 0; i < count; ++i)
    for (const int point : points_of_cell(i)) connectivity->SetValue(next++, point);
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, connectivity);
  grid.SetCells(types, cells);
}

template <class Position>
void set_points(vtkUnstructuredGrid& grid, int count, const Position& position) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  for (int i = 0; i < count; ++i) points->SetPoint(i, position(i).x(), position(i).y(), 0);
  grid.SetPoints(points);
}

void add_on_fracture_cells(vtkUnstructuredGrid& grid, const OutputField& field) {
  if (field.components != dimension) {
    grid.GetCellData()->AddArray(make_array(field, field.name));
    return;
  }
  OutputField numbers = field;  // as two numbers a cell instead of a pair
  numbers.components = 1;
  grid.GetCellData()->AddArray(make_array(numbers, field.name + ".normal", 0, dimension));
  grid.GetCellData()->AddArray(make_array(numbers, field.name + ".tangential", 1, dimension));
}

void require_size(const OutputField& field, const Mesh& mesh) {
  if (field.values.size() != static_cast<Eigen::Index>(entity_count(mesh, field.location)) * field.components)
    throw std::logic_error("output of " + field.name + ": wrong number of values");
}

void write(const std::filesystem::path& file, vtkUnstructuredGrid& grid) {
  vtkObject::GlobalWarningDisplayOff();  // failures are thrown below, not printed
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetFileName(partial_name(file).c_str());
  writer->SetInputData(&grid);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToNone();  // zlib takes forty times as long as writing
  writer->SetHeaderTypeToUInt64();
  if (writer->Write() == 0 || writer->GetErrorCode() != vtkErrorCode::NoError) {
    std::error_code ignored;
    std::filesystem::remove(partial_name(file), ignored);
    throw std::runtime_error("cannot write " + file.string() + " (" +
                             vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode()) + ")");
  }
  finish_partial(file);
}

}  // namespace

OutputField output_field(const Field& field) {
  return {field.name(), field.spec().unit, field.spec().location, field.spec().components, field.now()};
}

std::string labelled(const std::string& quantity, const std::string& unit) {
  return quantity + "[" + (unit.empty() ? "1" : unit) + "]";
}

void write_matrix_vtu(const std::filesystem::path& file, const Mesh& mesh, const std::vector<OutputField>& fields) {
  vtkNew<vtkUnstructuredGrid> grid;
  set_points(*grid, mesh.node_count(), [&](int i) { return mesh.nodes[i]; });
  set_cells(*grid, mesh.cell_count(), [&](int i) -> const Ring& { return mesh.cell_nodes[i]; });
  const auto region = make_array("region", mesh.cell_count());
  for (int i = 0; i < mesh.cell_count(); ++i) region->SetValue(i, mesh.cell_region[i]);
  grid->GetCellData()->AddArray(region);
  for (const OutputField& field : fields) {
    require_size(field, mesh);
    if (field.location == Location::cell) grid->GetCellData()->AddArray(make_array(field, field.name));
    if (field.location == Location::node) grid->GetPointData()->AddArray(make_array(field, field.name));
  }
  write(file, *grid);
}

void write_fracture_vtu(const std::filesystem::path& file, const Mesh& mesh, const std::vector<OutputField>& fields) {
  vtkNew<vtkUnstructuredGrid> grid;
  const int cell_count = mesh.fracture_cell_count();
  set_points(*grid, static_cast<int>(mesh.fracture_points.size()),
             [&](int i) { return mesh.fracture_points[i].position; });
  set_cells(*grid, cell_count, [&](int i) -> const std::array<int, 2>& { return mesh.fracture_cells[i].points; });
  const auto fracture = make_array("fracture", cell_count);
  for (int i = 0; i < cell_count; ++i) fracture->SetValue(i, mesh.fracture_cells[i].fracture);
  grid->GetCellData()->AddArray(fracture);
  for (const OutputField& field : fields) {
    require_size(field, mesh);
    if (field.location == Location::fracture_cell) add_on_fracture_cells(*grid, field);
    if (field.location == Location::wall) {
      grid->GetCellData()->AddArray(make_array(field, field.name + ".plus", static_cast<int>(Wall::plus), 2));
      grid->GetCellData()->AddArray(make_array(field, field.name + ".minus", static_cast<int>(Wall::minus), 2));
    }
  }
  write(file, *grid);
}

}  // namespace sprekk
