// Scenes and results of another dimension than that of this program.
#pragma once

namespace sprekk {

/// Thrown for a scene or results of another dimension (2, 3) than that of this program. The program for that dimension
/// takes over.
struct OtherDimension {
  int dimension;
};

}  // namespace sprekk
