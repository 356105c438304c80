// Derivatives of the multi-point fluxes by what the mobility follows.
#pragma once

#include <vector>

#include "components/matrix_flow/flux_derivatives.hpp"

namespace sprekk::matrix_flow {

/// See DifferentiateFluxes. Exact, from the local problems that give the fluxes; but what the singular flow around tips
/// of fractures and the stabilizers of regions of bent cells (LocalFluxes::Stabilizer) add is held.
std::vector<FluxDerivatives> differentiate_mpfa(const FlowInputs& flow, const std::vector<char>& nodes,
                                                const FluxState& state, const std::vector<std::vector<Tensor>>& by);

}  // namespace sprekk::matrix_flow
