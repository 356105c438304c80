// The cells around the tips of fractures to which the flow there is fitted.
#pragma once

#include <map>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk::matrix_flow {

/// For every tip the cells of the fit of its flow, ascending: the cells at its node, and the cells at those corners of
/// them that are near the tip. `tips`: see ends_nearby.
std::map<int, std::vector<int>> cells_around_tips(const Mesh& mesh, const std::vector<int>& tips);

}  // namespace sprekk::matrix_flow
