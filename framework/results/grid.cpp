#include "framework/results/grid.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numeric>

#include "framework/config/input_error.hpp"
#include "framework/module/module.hpp"
#include "framework/output/time_series.hpp"
#include "framework/output/vtk_module/vtk_module.hpp"

namespace sprekk {
namespace {

/// `sources`: for each entity of the grid, the entity of the file that holds its values.
void add_arrays(const std::vector<GridData::Array>& arrays, Grid::Place place, const std::vector<int>& sources,
                Grid& grid) {
  for (const GridData::Array& array : arrays) {
    Grid::Values values{array.name, place, array.components, {}, array.component_names};
    for (const int k : sources)
      for (int c = 0; c < array.components; ++c)
        values.values.push_back(array.values[static_cast<std::size_t>(k) * array.components + c]);
    grid.arrays.push_back(std::move(values));
  }
}

/// Runs write files whole: one without its last tag was cut off later. VTK would read it as a file with fewer fields.
void require_whole(const std::filesystem::path& vtu) {
  const std::string last_tag = "</VTKFile>";
  constexpr std::streamoff blank = 16;  // behind the tag, at most
  std::ifstream file(vtu, std::ios::binary | std::ios::ate);
  if (!file) return;  // the reader says so
  const std::streamoff size = file.tellg(),
                       length = std::min(size, static_cast<std::streamoff>(last_tag.size()) + blank);
  std::string end(static_cast<std::size_t>(length), ' ');
  file.seekg(size - length);
  file.read(end.data(), length);
  if (end.find(last_tag) == std::string::npos)
    throw InputError({vtu.string()}, "this is not a whole file of fields", "it has no end, so it was cut off",
                     "run the scene again");
}

}  // namespace

const Grid::Values* Grid::find(const std::string& name) const {
  for (const Values& values : arrays)
    if (values.name == name) return &values;
  return nullptr;
}

GridData read_whole(const std::filesystem::path& vtu) {
  require_whole(vtu);
  return module<VtkModule>("vtk").read(vtu);
}

void add_arrays(const GridData& read, Grid& grid) {
  std::vector<int> all_points(read.point_count());
  std::iota(all_points.begin(), all_points.end(), 0);
  add_arrays(read.on_cells, Grid::Place::cell, grid.sources, grid);
  add_arrays(read.on_points, Grid::Place::point, all_points, grid);
}

Grid read_grid(const std::filesystem::path& vtu) {
  const GridData read = read_whole(vtu);
  Grid grid;
  for (int i = 0; i < read.point_count(); ++i) grid.points.push_back({read.points[3 * i], read.points[3 * i + 1]});
  for (int i = 0; i < read.cell_count(); ++i) {
    const auto first = i == 0 ? 0 : read.cell_ends[i - 1];
    const auto corner = [&](int k) { return static_cast<int>(read.cell_points[first + k]); };
    const int count = static_cast<int>(read.cell_ends[i] - first);
    grid.points_per_cell = count == 2 ? 2 : 3;
    for (int k = 2; k < std::max(count, 3); ++k) {
      grid.sources.push_back(i);
      grid.cells.insert(grid.cells.end(), {corner(0), corner(k - 1)});
      if (count > 2) grid.cells.push_back(corner(k));
    }
  }
  add_arrays(read, grid);
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
