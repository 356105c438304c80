// Which fractures are connected by junctions.
#pragma once

#include <utility>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// For each fracture the smallest index of the fractures in its network; a fracture alone is its own network. `more`:
/// further pairs of connected fractures. A connection within a network closes a ring around a block of rock that only
/// the fractures hold.
std::vector<int> fracture_networks(const Mesh& mesh, const std::vector<std::pair<int, int>>& more = {});

}  // namespace sprekk
