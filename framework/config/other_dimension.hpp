// Scenes and results of another dimension than that of this program.
#pragma once

namespace sprekk {

/// Thrown where something is for the program of another dimension (2, 3), to which it is handed over.
struct OtherDimension {
  int dimension;
};

}  // namespace sprekk
