// The multi-point flux approximation (MPFA-O) on triangles and convex quadrilaterals, tetrahedra, wedges and hexahedra.
#pragma once

#include <vector>

#include "components/matrix_flow/flux_operators.hpp"
#include "components/matrix_flow/mpfa/limits.hpp"

namespace sprekk::matrix_flow {

/// Discretizes the flux by MPFA-O (Aavatsmark 2002), with the continuity points of continuity_point.
/// `mobility`: permeability tensor over viscosity of every cell (m^2/(Pa s)). `conditions`: one for each face.
/// `nodes`: the nodes whose interaction regions are to be discretized; empty means all. Rows of faces with an end
/// outside `nodes` are then incomplete and must not be used.
/// In a plane, fluxes near the tip of a fracture depend on the pressures of all cells around it, too (TipFlow).
/// Exact for linear pressures on any mesh; the mobility may be discontinuous and anisotropic.
FluxOperators discretize_mpfa(const Mesh& mesh, const std::vector<Tensor>& mobility,
                              const std::vector<FlowCondition>& conditions, const std::vector<char>& nodes = {});

/// discretize_mpfa with limits other than the default ones.
FluxOperators discretize_mpfa_with(const MpfaLimits& limits, const Mesh& mesh, const std::vector<Tensor>& mobility,
                                   const std::vector<FlowCondition>& conditions, const std::vector<char>& nodes = {});

}  // namespace sprekk::matrix_flow
