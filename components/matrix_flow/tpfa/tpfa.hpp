// The two-point flux approximation.
#pragma once

#include <vector>

#include "components/matrix_flow/flux_derivatives.hpp"
#include "components/matrix_flow/flux_operators.hpp"

namespace sprekk::matrix_flow {

/// Arguments as for discretize_mpfa. Monotone; consistent only on meshes orthogonal to the permeability.
FluxOperators discretize_tpfa(const Mesh& mesh, const std::vector<Tensor>& mobility,
                              const std::vector<FlowCondition>& conditions, const std::vector<char>& nodes = {});
/// See DifferentiateFluxes; exact.
std::vector<FluxDerivatives> differentiate_tpfa(const FlowInputs& flow, const std::vector<char>& nodes,
                                                const FluxState& state, const std::vector<std::vector<Tensor>>& by);

}  // namespace sprekk::matrix_flow
