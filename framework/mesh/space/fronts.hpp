// The lines along which fractures end in the rock.
#pragma once

#include <vector>

#include "framework/mesh/space/rim.hpp"

namespace sprekk {

/// Ridges of one fracture of kind tip, one behind the other: as seen from the plus side, a front goes clockwise around
/// its fracture. It ends on sides, and where fractures meet.
struct Front {
  int fracture;
  std::vector<int> ridges;
  std::vector<RimEdge> edges;  ///< of the ridges; their nodes in the direction of the front
  bool is_closed;
};

/// All fronts, in the order of their fractures.
std::vector<Front> fronts(const Mesh& mesh);

}  // namespace sprekk
