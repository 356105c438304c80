// A nonlinear finite-volume approximation of fluxes on triangles and convex quadrilaterals that keeps bounds.
#pragma once

#include <vector>

#include "components/matrix_flow/flux_operators.hpp"

namespace sprekk::matrix_flow {

/// Arguments as for discretize_mpfa; all rows are complete, whatever `nodes` says. Gives FluxOperators::limited.
///
/// From each cell, the flux out of it through a face is a sum of differences to pressures around, with coefficients
/// that are not negative: the conormal as a sum of two rays (CellRays). Through an inner face there are two such
/// fluxes. The part of the two-point difference that both fluxes contain is kept. The remainders are combined so that
/// the flux remains such a sum for both cells, whatever the pressures are (LimitedFluxes). So without a source no
/// pressure is higher or lower than all around it (Le Potier, C. R. Acad. Sci. Paris, Ser. I 341 (2005) 787 for such
/// fluxes; Lipnikov, Svyatskiy and Vassilevski, Russ. J. Numer. Anal. Math. Modelling 27 (2012) 369 for the combination
/// that keeps a maximum principle and not only the sign).
///
/// Exact for linear pressures where the conormals are such sums: in homogeneous rock where the rays of the first kinds
/// suffice, and across layers. Throws std::runtime_error if a mobility is not positive definite.
FluxOperators discretize_ntpfa(const Mesh& mesh, const std::vector<Tensor>& mobility,
                               const std::vector<FlowCondition>& conditions, const std::vector<char>& nodes = {});

}  // namespace sprekk::matrix_flow
