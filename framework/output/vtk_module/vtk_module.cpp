#include "framework/output/vtk_module/vtk_module.hpp"

#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSMPTools.h>
#include <vtkSmartPointer.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "framework/module/define_module.hpp"

namespace sprekk {
namespace {

std::vector<GridData::Array> arrays_of(vtkFieldData& data) {
  std::vector<GridData::Array> arrays;
  for (int i = 0; i < data.GetNumberOfArrays(); ++i) {
    vtkDataArray* const array = data.GetArray(i);
    if (array == nullptr || array->GetName() == nullptr) continue;
    GridData::Array read{array->GetName(), array->GetNumberOfComponents(), {}};
    for (vtkIdType k = 0; k < array->GetNumberOfTuples(); ++k)
      for (int c = 0; c < read.components; ++c) read.values.push_back(array->GetComponent(k, c));
    read.is_integer = array->GetDataType() == VTK_INT;
    for (int c = 0; c < read.components && array->HasAComponentName(); ++c)
      read.component_names.emplace_back(array->GetComponentName(c) ? array->GetComponentName(c) : "");
    arrays.push_back(std::move(read));
  }
  return arrays;
}

/// An array of VTK on the given memory, valid as long as this exists.
vtkSmartPointer<vtkDoubleArray> view_of(const std::vector<double>& values, int components) {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  constexpr int keep = 1;  // VTK shall not free them, nor does it change them
  array->SetNumberOfComponents(components);
  array->SetArray(const_cast<double*>(values.data()), static_cast<vtkIdType>(values.size()), keep);
  return array;
}

void add_arrays(vtkFieldData& data, const std::vector<GridData::Array>& arrays) {
  for (const GridData::Array& array : arrays) {
    vtkSmartPointer<vtkDataArray> added;
    if (array.is_integer) {
      vtkNew<vtkIntArray> integers;
      integers->SetNumberOfComponents(array.components);
      integers->SetNumberOfValues(static_cast<vtkIdType>(array.values.size()));
      std::copy(array.values.begin(), array.values.end(), integers->GetPointer(0));
      added = integers;
    } else {
      added = view_of(array.values, array.components);
    }
    added->SetName(array.name.c_str());
    for (std::size_t c = 0; c < array.component_names.size(); ++c)
      added->SetComponentName(static_cast<vtkIdType>(c), array.component_names[c].c_str());
    data.AddArray(added);
  }
}

int type_of(int dimension, std::int64_t points) {
  if (dimension == 3) return points == 4 ? VTK_TETRA : points == 6 ? VTK_WEDGE : VTK_HEXAHEDRON;
  return dimension == 1 ? VTK_LINE : points == 3 ? VTK_TRIANGLE : VTK_QUAD;
}

/// Between the order of gmsh and that of VTK, in which the normal of the first triangle of a wedge points out of it: of
/// the last six points.
void turn_wedge(std::vector<std::int64_t>& points) {
  const auto corner = points.end() - 6;
  std::swap(corner[1], corner[2]);
  std::swap(corner[4], corner[5]);
}

void set_cells(vtkUnstructuredGrid& grid, const GridData& data) {
  vtkNew<vtkTypeInt64Array> starts, points;
  vtkNew<vtkUnsignedCharArray> types;
  starts->InsertNextValue(0);
  std::vector<std::int64_t> ordered;
  ordered.reserve(data.cell_points.size());
  std::int64_t first = 0;
  for (const std::int64_t end : data.cell_ends) {
    ordered.insert(ordered.end(), data.cell_points.begin() + first, data.cell_points.begin() + end);
    const int type = type_of(data.cell_dimension, end - std::exchange(first, end));
    if (type == VTK_WEDGE) turn_wedge(ordered);
    starts->InsertNextValue(end);
    types->InsertNextValue(type);
  }
  points->SetNumberOfValues(static_cast<vtkIdType>(ordered.size()));
  std::copy(ordered.begin(), ordered.end(), points->GetPointer(0));
  vtkNew<vtkCellArray> cells;
  cells->SetData(starts, points);
  grid.SetCells(types, cells);
}

class Module final : public VtkModule {
 public:
  GridData read(const std::filesystem::path& vtu) const override {
    vtkObject::GlobalWarningDisplayOff();  // failures are thrown below, not printed
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName(vtu.c_str());
    if (!std::filesystem::exists(vtu) || reader->CanReadFile(vtu.c_str()) == 0)
      throw std::runtime_error("cannot read " + vtu.string());
    reader->Update();
    if (reader->GetErrorCode() != vtkErrorCode::NoError)
      throw std::runtime_error("cannot read " + vtu.string() + " (" +
                               vtkErrorCode::GetStringFromErrorCode(reader->GetErrorCode()) + ")");
    vtkUnstructuredGrid& grid = *reader->GetOutput();
    GridData data;
    for (vtkIdType i = 0; i < grid.GetNumberOfPoints(); ++i) {
      double position[3];
      grid.GetPoint(i, position);
      data.points.insert(data.points.end(), position, position + 3);
    }
    vtkNew<vtkIdList> corners;
    for (vtkIdType i = 0; i < grid.GetNumberOfCells(); ++i) {
      grid.GetCellPoints(i, corners);
      for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k) data.cell_points.push_back(corners->GetId(k));
      data.cell_ends.push_back(static_cast<std::int64_t>(data.cell_points.size()));
      if (grid.GetCellType(i) == VTK_WEDGE) turn_wedge(data.cell_points);
    }
    if (data.cell_count() > 0) data.cell_dimension = grid.GetCell(0)->GetCellDimension();
    data.on_cells = arrays_of(*grid.GetCellData());
    data.on_points = arrays_of(*grid.GetPointData());
    return data;
  }

  std::string text_of(const GridData& data) const override {
    // The range of each array is found in this thread: more of them cost more than they gain.
    vtkSMPTools::SetBackend("Sequential");
    vtkNew<vtkUnstructuredGrid> grid;
    vtkNew<vtkPoints> points;
    points->SetData(view_of(data.points, 3));
    grid->SetPoints(points);
    set_cells(*grid, data);
    add_arrays(*grid->GetPointData(), data.on_points);
    add_arrays(*grid->GetCellData(), data.on_cells);
    vtkNew<vtkXMLUnstructuredGridWriter> writer;
    writer->SetInputData(grid);
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressorTypeToNone();
    writer->SetHeaderTypeToUInt64();
    writer->WriteToOutputStringOn();
    if (writer->Write() == 0) throw std::runtime_error("VTK cannot write a grid");
    return writer->GetOutputString();
  }
};

}  // namespace
}  // namespace sprekk

SPREKK_DEFINE_MODULE(sprekk::VtkModule, sprekk::Module)
