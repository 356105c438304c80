// Hands the command line over to the program for another dimension.
#pragma once

#include <string>

namespace sprekk {

/// Goes on, with the same arguments, as the program for scenes of this dimension, which lies beside this one: NAME for
/// a plane, NAME-space for space. Returns only by throwing std::runtime_error, where there is no such program.
[[noreturn]] void hand_over(int dimension, char** arguments);

/// What the program for this dimension prints for a command, "schema". Throws std::runtime_error where it cannot be
/// started or fails.
std::string said_by_program(int dimension, const std::string& command);

}  // namespace sprekk
