// Whether the flow around a tip gains energy by its correction.
#pragma once

#include <vector>

#include "components/matrix_flow/mpfa/tip_flow.hpp"

namespace sprekk::matrix_flow {

/// The largest part of a tip's flow, in quarters, with which the local problems of its nodes together gain no energy
/// (LocalFluxes), whatever the pressures; mostly 1. On flat or few cells the amounts of the flow may depend on
/// pressures so much that what they add to the fluxes drives itself. Each node has one tip at most, so none of the
/// whole gains any then. `nodes`: those that are corrected.
double lossy_part(const TipFlow& flow, const Mesh& mesh, const std::vector<int>& nodes,
                  const std::vector<Tensor>& mobility, const std::vector<FlowCondition>& conditions);

}  // namespace sprekk::matrix_flow
