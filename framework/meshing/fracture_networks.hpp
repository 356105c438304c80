// Which fractures are connected by junctions.
#pragma once

#include <utility>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// Per fracture the smallest index of a fracture that it is connected with, itself included; also by `more` pairs. A
/// connection within a network closes a ring around a piece of rock that nothing else holds.
std::vector<int> fracture_networks(const Mesh& mesh, const std::vector<std::pair<int, int>>& more = {});

}  // namespace sprekk
