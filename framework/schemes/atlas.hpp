// The atlas of coupling schemes: all sensible splits of a scene, run from the same start.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/run/exit_code.hpp"

namespace sprekk {

/// The arguments of `sprekk schemes`.
struct AtlasOptions {
  std::vector<std::string> scene_files, settings;  ///< settings: "path=value"
  std::vector<std::string> accelerations;          ///< "aitken: {}"; all that are usual if there are none
  std::vector<std::string> only;                   ///< parts of names of schemes; all schemes if there are none
  std::vector<std::string> over;                   ///< two at most, "path=value,value": a map for each scheme
  int steps = 3;                                   ///< of each run
  double until = 1e-8;                             ///< as that of a scene
  int at_most = 60;                                ///< passes; more have not converged
  std::optional<std::filesystem::path> folder;
  int processes = 0;  ///< runs at a time
  bool is_quiet = false;
};

/// Runs the schemes as a study in the folder, and writes schemes.html, schemes.csv and schemes.json. A scheme that does
/// not converge is a result, not a failure. Returns `failed` when the monolithic scheme does not converge. Throws
/// InputError.
ExitCode run_atlas(const AtlasOptions& options);

}  // namespace sprekk
