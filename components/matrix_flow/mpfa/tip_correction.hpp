// Corrects a local problem for the singular flow around the tip of a fracture.
#pragma once

#include <vector>

#include "components/matrix_flow/mpfa/local_fluxes.hpp"
#include "components/matrix_flow/mpfa/tip_flow.hpp"
#include "framework/discretization/interaction_region.hpp"

namespace sprekk::matrix_flow {

/// The difference between the singular flow (TipFlow) and its approximation by a local problem with linear pressures.
/// It is added to the fluxes and pressures of the local problem: with linear pressures around a tip alone, a fracture
/// exchanges as much fluid as one that is longer or shorter by a part of an edge. It vanishes for linear pressures, for
/// which the method stays exact.
class TipCorrection {
 public:
  TipCorrection(const TipFlow& flow, const Mesh& mesh, const InteractionRegion& region, const LocalFluxes& local,
                int node, const std::vector<Tensor>& mobility, const std::vector<FlowCondition>& conditions);

  /// The corrections of the flux through an inner subface (m^2/s; m^3/s in space), and of the pressure at a wall (Pa),
  /// for modes with amounts of 1.
  TipFlow::Modes of_flux(int subface) const;
  TipFlow::Modes of_pressure(int subface) const;

 private:
  double mobility_of(int face) const;  ///< the mean of its cells, m^2/(Pa s)
  int side_of(int face) const;         ///< on which the region sees its part of the face
  Point continuity_point(int subface) const;
  TipFlow::Modes missing(const double* coefficients, TipFlow::Modes exact) const;

  const TipFlow& flow_;
  const Mesh& mesh_;
  const InteractionRegion& region_;
  const LocalFluxes& local_;
  const std::vector<Tensor>& mobility_;
  int node_;
  int side_ = 0;  ///< of the region; 0 at the tip itself
  /// The inputs of the local problem for each mode: pressures of the subcells, and boundary values of the walls.
  std::vector<TipFlow::Modes> inputs_;
};

}  // namespace sprekk::matrix_flow
