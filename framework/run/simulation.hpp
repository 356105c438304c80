// A run: the time loop with its results.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/run/exit_code.hpp"
#include "framework/scene/scene.hpp"

namespace sprekk {

/// Options of `sprekk run`.
struct RunOptions {
  std::vector<std::string> scene_files;
  std::optional<std::filesystem::path> folder;      ///< -o
  std::optional<std::filesystem::path> checkpoint;  ///< of --restart
  bool quiet = false;
};

/// Runs a scene to its end. Writes run.json, history.csv, coupling.csv, fields and checkpoints into the output folder.
/// An interrupt (SIGINT, SIGTERM) ends the run after the current step with a checkpoint; a failure leaves the
/// checkpoint of the last accepted step. Throws InputError before anything is written.
ExitCode run_scene(const Scene& scene, const RunOptions& options);

}  // namespace sprekk
