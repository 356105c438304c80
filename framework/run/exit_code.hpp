// The exit codes of the program.
#pragma once

namespace sprekk {

/// How a run, or several, ended, as exit code of the program.
enum class ExitCode { done = 0, failed = 1, wrong_input = 2, interrupted = 130 };

}  // namespace sprekk
