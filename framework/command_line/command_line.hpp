// The command line: `sprekk run scene.yaml` and all other commands.
#pragma once

namespace sprekk {

/// Exit codes: 0 done, 1 the run failed, 2 the input is wrong, 130 interrupted.
int run_command_line(int argc, char** argv);

}  // namespace sprekk
