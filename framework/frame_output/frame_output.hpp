// Outputs: what a run writes at its times of output, each by a class of its own.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/field/output_field.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk {

struct OutputLine;

/// The whole state at a time of output, with all processes' values.
struct Frame {
  double time;  ///< s
  int step;     ///< accepted steps so far; 0 at the start
  const Mesh& mesh;
  const std::vector<OutputField>& fields;  ///< unknowns and inputs, then what parts write beside their fields
  const std::vector<OutputLine>& lines;    ///< parts of fractures that the mesh does not have yet
};

/// Where an output writes, and from which time on.
struct OutputPlace {
  std::filesystem::path folder;          ///< results folder of the run; it exists
  std::optional<double> continued_from;  ///< s, where a run is continued: later rows in existing files are replaced
};

/// One output of a run. It exists on the first process only, and must not call anything collective.
class FrameOutput {
 public:
  virtual ~FrameOutput() = default;
  /// Throws std::runtime_error when a file cannot be written.
  virtual void write(const Frame& frame) = 0;
  /// What to tell the user of files that were removed meanwhile (TableWriter::loss); empty if none was.
  virtual std::string loss() const { return ""; }
};

}  // namespace sprekk
