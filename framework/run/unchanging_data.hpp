// Notes on data that look as if they changed and are the same throughout a run, and on windows that add up.
#pragma once

#include "framework/assembly/notes.hpp"
#include "framework/config/node.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// Where and when a run has values.
struct RunExtent {
  double start = 0, first_step = 0, end = 0;  ///< s
  Point lowest{0, 0}, highest{0, 0};          ///< of the mesh, m
};

/// Notes, for all data of a scene: comparisons of t, x or y with a number without a unit that no step or place of the
/// run tells apart, windows in time outside of the run, and windows of one datum that overlap.
void note_unchanging_data(Notes& notes, const Node& scene, const RunExtent& run);

}  // namespace sprekk
