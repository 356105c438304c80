// The environment that this process was started with.
#pragma once

#include <string>
#include <vector>

namespace sprekk::parallel {

/// "NAME=VALUE" of each variable, without those that MPI has added since: they are for this process alone, and must not
/// be inherited by programs that it starts.
std::vector<std::string> environment_at_start();

}  // namespace sprekk::parallel
