// The exit codes of the program.
#pragma once

namespace sprekk {

/// The exit code of the program for one run or for several.
/// `differs`: runs are further apart than the tolerance of a comparison.
enum class ExitCode { done = 0, failed = 1, wrong_input = 2, differs = 3, interrupted = 130 };

}  // namespace sprekk
