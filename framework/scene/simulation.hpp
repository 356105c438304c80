// A run: the time loop with its results.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/output/profile.hpp"
#include "framework/output/run_record.hpp"
#include "framework/scene/model.hpp"
#include "framework/schedule/step_controller.hpp"

namespace sprekk {

struct RunOptions {
  std::vector<std::string> scene_files;
  std::optional<std::filesystem::path> folder;      ///< -o
  std::optional<std::filesystem::path> checkpoint;  ///< of --restart
  bool quiet = false;
};

enum class ExitCode { done = 0, failed = 1, wrong_input = 2, interrupted = 130 };

/// Runs a scene to its end. Writes run.json, history.csv, coupling.csv, fields and checkpoints into the output folder.
/// An interrupt (SIGINT, SIGTERM) ends the run after the current step with a checkpoint; a failure leaves the
/// checkpoint of the last accepted step. Throws InputError before anything is written.
ExitCode run_scene(const Scene& scene, const RunOptions& options);

/// What identifies a scene for a restart: all of it except the end time, the output and the name.
std::string scene_fingerprint(const Scene& scene);

}  // namespace sprekk
