// Derivatives of the multi-point fluxes by the variables of the mobility.
#pragma once

#include <vector>

#include "components/matrix_flow/flux_derivatives.hpp"

namespace sprekk::matrix_flow {

/// See DifferentiateFluxes. Exact, from the local problems that give the fluxes, except for two contributions that are
/// held: the singular flow around tips of fractures, and the stabilizers of regions with bent cells
/// (LocalFluxes::Stabilizer).
std::vector<FluxDerivatives> differentiate_mpfa(const FlowInputs& flow, const std::vector<char>& nodes,
                                                const FluxState& state, const std::vector<std::vector<Tensor>>& by);

}  // namespace sprekk::matrix_flow
