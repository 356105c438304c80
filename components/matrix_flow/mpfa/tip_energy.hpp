// Limits the correction of the flow around a tip so that no flow gains energy.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "components/matrix_flow/mpfa/tip_flow.hpp"

namespace sprekk::matrix_flow {

/// The largest part of 1, 3/4, 1/2, 1/4 and 0 for which the power x^T (linear + part · added) x is not negative for any
/// x.
double dissipative_part(const Eigen::MatrixXd& linear, const Eigen::MatrixXd& added);

/// The largest part (1, 3/4, 1/2, 1/4 or 0) of a tip's correction with which the local problems of its nodes together
/// gain no energy (LocalFluxes), for any pressures; mostly 1. In flat cells, or with few of them, the fitted amounts of
/// the singular flow may depend so strongly on pressures that the corrected fluxes gain energy. Each node has at most
/// one tip, so the whole discretization then gains no energy either. `nodes`: the nodes that are corrected.
double dissipative_share(const TipFlow& flow, const Mesh& mesh, const std::vector<int>& nodes,
                         const std::vector<Tensor>& mobility, const std::vector<FlowCondition>& conditions);

}  // namespace sprekk::matrix_flow
