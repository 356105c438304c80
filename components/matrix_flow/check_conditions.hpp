// Checks the arguments of discretizations of the flux.
#pragma once

#include <vector>

#include "components/matrix_flow/flux_operators.hpp"

namespace sprekk::matrix_flow {

/// Throws std::invalid_argument unless there is one mobility for each cell, one condition for each face, with `none` on
/// the inner faces only, and one flag for each node, or no flags.
void check_conditions(const Mesh& mesh, const std::vector<Tensor>& mobility,
                      const std::vector<FlowCondition>& conditions, const std::vector<char>& nodes);

}  // namespace sprekk::matrix_flow
