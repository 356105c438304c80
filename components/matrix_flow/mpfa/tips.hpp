// The local problems near the ends of fractures.
#pragma once

#include <memory>
#include <vector>

#include "components/matrix_flow/mpfa/limits.hpp"
#include "components/matrix_flow/mpfa/local_fluxes.hpp"
#include "framework/mesh/adjacency.hpp"

namespace sprekk::matrix_flow {

/// Fluxes and pressures of local problems by the pressures of cells. Near the tips of fractures they include the
/// singular flow (TipFlow, TipCorrection), which depends on the pressures of all cells around a tip. In space a tip is
/// a node of a rim.
class Tips {
 public:
  /// `nodes`: those that are discretized; empty means all. The mesh and what describes it outlive the tips.
  Tips(const MpfaLimits& limits, const Mesh& mesh, const std::vector<Tensor>& mobility,
       const std::vector<FlowCondition>& conditions, const std::vector<char>& nodes);

  /// The cells whose pressures enter the local problem of each node, ascending.
  const Adjacency& cells_of_nodes() const;

  /// Takes the local problem of a node, which is solved and outlives the use of its coefficients.
  void assign(int node, const InteractionRegion& region, const LocalFluxes& local);
  /// Coefficients of LocalFluxes with respect to cells_of_nodes.
  const double* flux(int subface);
  const double* pressure(int subface);

 private:
  struct Content;
  const Mesh& mesh_;
  const LocalFluxes* local_ = nullptr;
  std::shared_ptr<Content> content_;
};

}  // namespace sprekk::matrix_flow
