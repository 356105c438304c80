// Hands the command line over to the program for another dimension.
#pragma once

namespace sprekk {

/// Goes on, with the same arguments, as the program for scenes of this dimension, which lies beside this one: NAME for
/// a plane, NAME-space for space. Returns only by throwing std::runtime_error, where there is no such program.
[[noreturn]] void hand_over(int dimension, char** arguments);

}  // namespace sprekk
