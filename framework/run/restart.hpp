// The checkpoint from which a run is continued.
#pragma once

#include <filesystem>

#include "framework/output/checkpoint.hpp"
#include "framework/run/run_output.hpp"
#include "framework/run/simulation_state.hpp"

namespace sprekk {

/// Continues a run from a checkpoint.
class Restart {
 public:
  /// Reads the file, and locks the folder of `output`, which contains the file. Throws InputError when the file is no
  /// checkpoint of this scene, naming the parameters that differ, or when another run has locked the folder.
  /// Collective.
  Restart(const Scene& scene, const std::filesystem::path& file, RunOutput& output);

  /// Of the checkpoint, which may have grown; divided among the processes of today.
  Mesh mesh(Division division) const;

  /// Puts the checkpoint's values into the state, whose model is on `mesh()`. Throws InputError when they do not fit.
  void restore(SimulationState& state) const;
  RunOutput::Continued continued(const SimulationState& restored) const;

 private:
  std::filesystem::path file_;
  Checkpoint checkpoint_;
};

/// For a run that is continued, which appends to tables with given columns: throws InputError when history.csv lacks
/// the column of one of the quantities.
void require_columns(const std::vector<Quantity>& quantities, const RunOutput& output);

}  // namespace sprekk
