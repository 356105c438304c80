// The state of a run of a study: one entry of sweep.json.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "framework/study/study.hpp"

namespace sprekk {

/// Whether a run of a study has been done, and how it ended.
struct RunState {
  /// How far the run is.
  enum class Status { waiting, done, failed, interrupted };

  std::string name, identity;
  Status status = Status::waiting;
  int exit_code = -1;    ///< of the run, or minus the number of the signal that ended it
  std::string reason;    ///< why the run failed
  double seconds = 0;    ///< wall time of all its parts
  std::string program;   ///< version and commit of the program
  bool is_lost = false;  ///< the run has ended and its record does not say how: its machine has failed
};

/// What to do with a run: keep its results, start it, or continue it from its checkpoint.
enum class Action { keep, start, go_on };

/// The states in `folder`/sweep.json by name; none when there is no such file. Throws InputError if it is damaged.
std::map<std::string, RunState> read_states(const std::filesystem::path& folder);

/// Decides what to do with one run, from the remembered states. Throws InputError when its folder holds a run with
/// other values: results are never overwritten.
Action next_action(const StudyRun& run, const std::map<std::string, RunState>& remembered,
                   const std::filesystem::path& folder);

/// Sets the state of a run that has ended with `code`, from run.json in `run_folder` and from the log. `launched`: the
/// code is that of a launcher.
void record_end(RunState& state, int code, const std::filesystem::path& run_folder, const std::filesystem::path& log,
                bool launched = false);

std::string status_text(RunState::Status status);  ///< "done", "failed", …

}  // namespace sprekk
