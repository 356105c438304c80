// The lines along which fractures end in the rock.
#pragma once

#include <vector>

#include "framework/mesh/space/rim.hpp"

namespace sprekk {

/// A line of ridges of the kind `tip` of one fracture, in order: as seen from the plus side, clockwise around the
/// fracture. It is closed, or ends on sides and where fractures meet.
struct FrontLine {
  int fracture;
  std::vector<int> ridges;
  std::vector<RimEdge> edges;  ///< of the ridges; their nodes in the direction of the front
  bool is_closed;
};

/// All fronts, in the order of their fractures.
std::vector<FrontLine> fronts(const Mesh& mesh);

}  // namespace sprekk
