#include "framework/output/field_series.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/module/module.hpp"

namespace sprekk {

FieldSeries::FieldSeries(std::filesystem::path folder, TimeSeries matrix, TimeSeries fractures, TimeSeries paths,
                         TimeSeries fronts)
    : folder_(std::move(folder)),
      matrix_(std::move(matrix)),
      fractures_(std::move(fractures)),
      paths_(std::move(paths)),
      fronts_(std::move(fronts)) {
  open_module("vtk");  // throws before the run starts if fields cannot be written
}

FieldSeries::FieldSeries(const std::filesystem::path& folder)
    : FieldSeries(folder, TimeSeries(folder / "matrix.pvd"), TimeSeries(folder / "fractures.pvd"),
                  TimeSeries(folder / "paths.pvd"), TimeSeries(folder / "fronts.pvd")) {}

FieldSeries FieldSeries::continued(const std::filesystem::path& folder, double time) {
  return {folder, TimeSeries::continued(folder / "matrix.pvd", time),
          TimeSeries::continued(folder / "fractures.pvd", time), TimeSeries::continued(folder / "paths.pvd", time),
          TimeSeries::continued(folder / "fronts.pvd", time)};
}

void FieldSeries::write(double time, int step, const Mesh& mesh, const std::vector<OutputField>& fields,
                        const std::vector<OutputLine>& lines, PointData points) {
  const std::string matrix_file = fmt::format("matrix_{:06}.vtu", step);
  write_matrix_vtu(folder_ / matrix_file, mesh, fields, points);
  matrix_.add(time, matrix_file);
  if (mesh.fracture_cells.empty()) return;
  const std::string fracture_file = fmt::format("fractures_{:06}.vtu", step);
  write_fracture_vtu(folder_ / fracture_file, mesh, fields);
  fractures_.add(time, fracture_file);
  if (std::ranges::any_of(fields, [](const OutputField& field) { return field.location == Location::ridge; })) {
    const std::string front_file = fmt::format("fronts_{:06}.vtu", step);
    write_front_vtu(folder_ / front_file, mesh, fields);
    fronts_.add(time, front_file);
  }
  // Empty files, too: a picture of this time must not show the lines of an earlier one.
  if (lines.empty() && paths_.entries().empty()) return;
  const std::string line_file = fmt::format("paths_{:06}.vtu", step);
  write_line_vtu(folder_ / line_file, lines);
  paths_.add(time, line_file);
}

}  // namespace sprekk
