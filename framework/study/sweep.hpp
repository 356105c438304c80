// Runs a study: every run a process of its own in a sub-folder, some at a time, and then one table and one picture.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "framework/run/exit_code.hpp"
#include "framework/study/study.hpp"

namespace sprekk {

struct SweepOptions {
  std::optional<std::filesystem::path> folder;  ///< `results/<study>` by default
  int processes = 0;                            ///< at a time; 0: as many as there are cores
  bool quiet = false;
  bool only_list = false;                  ///< says what would be done, and does nothing
  std::string program = "/proc/self/exe";  ///< that has the command `run`
};

/// Runs that are done already, with the same values, are kept; interrupted and failed ones go on from their checkpoint.
/// Writes sweep.csv, sweep.json and sweep.svg. An interrupt is passed on to the runs, which stop with a checkpoint.
/// `failed` when a run failed, after all others have ended. Throws InputError before any run has begun.
ExitCode run_sweep(const Study& study, const SweepOptions& options);

}  // namespace sprekk
