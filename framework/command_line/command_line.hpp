// The command line: `sprekk run scene.yaml` and all other commands.
#pragma once

#include <string>
#include <vector>

#include "framework/command_line/new_command.hpp"

namespace sprekk {

/// What the program is for, as its help and its manual page say it. The caller gives it: the framework serves any
/// physics.
struct ProgramPurpose {
  std::string summary;                       ///< a line without a full stop
  std::string description;                   ///< one sentence
  std::vector<TemplateFile> templates = {};  ///< of what `sprekk new` writes
};

/// Runs the command that the arguments of `main` ask for. Returns the exit code: 0 done, 1 the run failed, 2 the input
/// is wrong, 3 compared runs differ by more than the tolerance, 130 interrupted.
int run_command_line(int argc, char** argv, const ProgramPurpose& purpose);

}  // namespace sprekk
