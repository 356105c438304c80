#include "framework/results/grid.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "framework/output/time_series.hpp"

namespace sprekk {
namespace {

/// `sources`: for each entity of the grid, the tuple that holds its values.
void add_arrays(vtkFieldData& data, Grid::Place place, const std::vector<vtkIdType>& sources, Grid& grid) {
  for (int i = 0; i < data.GetNumberOfArrays(); ++i) {
    vtkDataArray* const array = data.GetArray(i);
    if (array == nullptr || array->GetName() == nullptr) continue;
    const int components = array->GetNumberOfComponents();
    Grid::Values values{array->GetName(), place, components, {}};
    for (const vtkIdType k : sources)
      for (int c = 0; c < components; ++c) values.values.push_back(array->GetComponent(k, c));
    grid.arrays.push_back(std::move(values));
  }
}

}  // namespace

const Grid::Values* Grid::find(const std::string& name) const {
  for (const Values& values : arrays)
    if (values.name == name) return &values;
  return nullptr;
}

Grid read_grid(const std::filesystem::path& vtu) {
  vtkObject::GlobalWarningDisplayOff();  // failures are thrown below, not printed
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(vtu.c_str());
  if (!std::filesystem::exists(vtu) || reader->CanReadFile(vtu.c_str()) == 0)
    throw std::runtime_error("cannot read " + vtu.string());
  reader->Update();
  if (reader->GetErrorCode() != vtkErrorCode::NoError)
    throw std::runtime_error("cannot read " + vtu.string() + " (" +
                             vtkErrorCode::GetStringFromErrorCode(reader->GetErrorCode()) + ")");
  vtkUnstructuredGrid& read = *reader->GetOutput();
  Grid grid;
  for (vtkIdType i = 0; i < read.GetNumberOfPoints(); ++i) {
    double position[3];
    read.GetPoint(i, position);
    grid.points.push_back({position[0], position[1]});
  }
  vtkNew<vtkIdList> corners;
  std::vector<vtkIdType> cell_of;  // of each triangle or line of the grid
  for (vtkIdType i = 0; i < read.GetNumberOfCells(); ++i) {
    read.GetCellPoints(i, corners);
    const auto corner = [&](int k) { return static_cast<int>(corners->GetId(k)); };
    const int count = static_cast<int>(corners->GetNumberOfIds());
    grid.points_per_cell = count == 2 ? 2 : 3;
    for (int k = 2; k < std::max(count, 3); ++k) {
      cell_of.push_back(i);
      grid.cells.insert(grid.cells.end(), {corner(0), corner(k - 1)});
      if (count > 2) grid.cells.push_back(corner(k));
    }
  }
  std::vector<vtkIdType> all_points(static_cast<std::size_t>(read.GetNumberOfPoints()));
  std::iota(all_points.begin(), all_points.end(), 0);
  add_arrays(*read.GetCellData(), Grid::Place::cell, cell_of, grid);
  add_arrays(*read.GetPointData(), Grid::Place::point, all_points, grid);
  return grid;
}

std::vector<Snapshot> read_index(const std::filesystem::path& pvd) {
  std::vector<Snapshot> snapshots;
  const TimeSeries series = TimeSeries::continued(pvd, std::numeric_limits<double>::infinity());
  for (const TimeSeries::Entry& entry : series.entries())
    snapshots.push_back({entry.time, pvd.parent_path() / entry.file});
  return snapshots;
}

std::vector<Snapshot> evenly_chosen(const std::vector<Snapshot>& all, std::size_t count) {
  if (all.size() <= count) return all;
  std::vector<Snapshot> chosen;
  const double stride = static_cast<double>(all.size() - 1) / static_cast<double>(count - 1);
  for (std::size_t i = 0; i < count; ++i)
    chosen.push_back(all[static_cast<std::size_t>(std::lround(static_cast<double>(i) * stride))]);
  return chosen;
}

}  // namespace sprekk
