// Runs a study: each run is a process with a sub-folder of its own, several at a time; then one table and one picture.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/run/exit_code.hpp"
#include "framework/study/study.hpp"

namespace sprekk {

/// Options of `sprekk sweep`.
struct SweepOptions {
  std::optional<std::filesystem::path> folder;  ///< `results/<study>` by default
  int processes = 0;                            ///< at a time; 0: as many as there are cores
  bool quiet = false;
  bool has_table = true;                    ///< prints the figures in the end, unless quiet
  bool tells_failures = true;               ///< also when quiet
  bool only_list = false;                   ///< only list what would be done
  std::vector<std::string> launchers = {};  ///< commands that start runs
  int repeats = 2;                          ///< of a run that a launcher has lost
  std::string program = "/proc/self/exe";   ///< the program with the command `run`
};

/// Runs a study. Runs that are done already, with the same values, are kept; interrupted and failed runs go on from
/// their checkpoints. Writes sweep.csv, sweep.json and sweep.svg. An interrupt is passed on to the runs, which stop
/// with a checkpoint. With launchers the processes are theirs, each with its share; a run that ends without saying how
/// (its machine is gone) goes on elsewhere. Returns `failed` when a run failed, after all others have ended. Throws
/// InputError before any run has begun.
ExitCode run_sweep(const Study& study, const SweepOptions& options);

}  // namespace sprekk
