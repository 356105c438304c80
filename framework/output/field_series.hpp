// The fields of a run: for each written step one file for the matrix and one for the fractures, and index files.
#pragma once

#include <filesystem>
#include <vector>

#include "framework/output/time_series.hpp"
#include "framework/output/vtu_writer.hpp"

namespace sprekk {

/// Writes folder/matrix_000010.vtu, folder/fractures_000010.vtu (if there are fractures), matrix.pvd and fractures.pvd;
/// also folder/paths_000010.vtu and paths.pvd from the first time on at which there are lines that the mesh does not
/// have, and fronts_000010.vtu and fronts.pvd where there are fields on ridges.
class FieldSeries {
 public:
  explicit FieldSeries(const std::filesystem::path& folder);
  /// After a restart from `time` (s): files that were written for later times are replaced.
  static FieldSeries continued(const std::filesystem::path& folder, double time);

  void write(double time, int step, const Mesh& mesh, const std::vector<OutputField>& fields,
             const std::vector<OutputLine>& lines = {}, PointData points = PointData::only_fields_on_nodes);

 private:
  FieldSeries(std::filesystem::path folder, TimeSeries matrix, TimeSeries fractures, TimeSeries paths,
              TimeSeries fronts);

  std::filesystem::path folder_;
  TimeSeries matrix_, fractures_, paths_, fronts_;
};

}  // namespace sprekk
