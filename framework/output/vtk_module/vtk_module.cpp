#include "framework/output/vtk_module/vtk_module.hpp"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <stdexcept>

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
    arrays.push_back(std::move(read));
  }
  return arrays;
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
    }
    data.on_cells = arrays_of(*grid.GetCellData());
    data.on_points = arrays_of(*grid.GetPointData());
    return data;
  }
};

}  // namespace
}  // namespace sprekk

SPREKK_DEFINE_MODULE(sprekk::VtkModule, sprekk::Module)
