// Value ± error of figures of a scene, from runs with finer and coarser parameters.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/run/exit_code.hpp"

namespace sprekk {

/// The arguments of `sprekk converge`.
struct ConvergenceOptions {
  std::vector<std::string> scene_files, settings;  ///< settings: "path=value"
  std::vector<std::string> quantities;             ///< "slip.t", "slip.t@6 h", "slip.t@largest"
  std::vector<std::string> refine;                 ///< names of refinements; all that the scene has if there are none
  std::string to;                                  ///< wanted error, "1%" of the value; "" for none
  double coarsest = 2;                             ///< factor of the coarsest level; the others are 1/2 and 1/4 of it
  std::optional<std::filesystem::path> folder;
  int processes = 0;  ///< runs at a time
  bool is_quiet = false;
};

/// Runs the scene on three levels of each parameter, and with all of them on the finest, as a study in the folder;
/// tells the errors, and writes converge.json. With `to`, runs the cheapest setting whose stated error is small enough.
/// Returns `failed` when a run has failed, or when that setting is not as good as wanted. Throws InputError.
ExitCode run_convergence(const ConvergenceOptions& options);

}  // namespace sprekk
