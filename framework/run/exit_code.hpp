// How a run, or several, have ended, as the command line answers.
#pragma once

namespace sprekk {

enum class ExitCode { done = 0, failed = 1, wrong_input = 2, interrupted = 130 };

}  // namespace sprekk
