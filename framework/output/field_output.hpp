// The fields of a run through time: one file a written step for the matrix, one for the fractures, and their indices.
#pragma once

#include <filesystem>
#include <vector>

#include "framework/output/time_series.hpp"
#include "framework/output/vtu_writer.hpp"

namespace sprekk {

/// Writes folder/matrix_000010.vtu, folder/fractures_000010.vtu (if there are fractures), matrix.pvd and fractures.pvd.
class FieldOutput {
 public:
  explicit FieldOutput(const std::filesystem::path& folder);
  /// After a restart from `time` (s): what was written later is replaced.
  static FieldOutput continued(const std::filesystem::path& folder, double time);

  void write(double time, int step, const Mesh& mesh, const std::vector<OutputField>& fields);

 private:
  FieldOutput(std::filesystem::path folder, TimeSeries matrix, TimeSeries fractures);

  std::filesystem::path folder_;
  TimeSeries matrix_, fractures_;
};

}  // namespace sprekk
