// The fluxes around one node: the local problem of the MPFA-O method.
#pragma once

#include <array>
#include <vector>

#include "components/matrix_flow/flux_operators.hpp"
#include "framework/mesh/interaction_region.hpp"

namespace sprekk::matrix_flow {

/// In every subcell the pressure is linear; pressures agree at the continuity points and fluxes agree on the subfaces
/// (Aavatsmark 2002, sec. 3). Coefficients are with respect to the pressures of the region's subcells and the values of
/// its subfaces with one cell (their boundary values for whole faces), in this order. The value of a face with a given
/// pressure is meant at its continuity point.
class LocalFluxes {
 public:
  /// Throws std::runtime_error if the local system is singular.
  void solve(const Mesh& mesh, int node, const InteractionRegion& region, const std::vector<Tensor>& mobility,
             const std::vector<FlowCondition>& conditions);

  /// The pressure at the continuity point of a subface.
  const double* pressure(int subface) const { return system_.data() + subface * (subfaces_ + columns_) + subfaces_; }
  /// The flux through a subface out of its first cell (m^2/s).
  const double* flux(int subface) const { return fluxes_.data() + subface * columns_; }
  /// Where the continuity point lies, from the centre of the face (0) to the node (1).
  double towards_node(int subface) const { return towards_node_[subface]; }

 private:
  void solve(const InteractionRegion& region, const std::vector<Tensor>& mobility,
             const std::vector<FlowCondition>& conditions);

  int subfaces_ = 0, columns_ = 0;
  std::vector<double> system_, fluxes_;
  std::vector<double> towards_node_;
  std::vector<std::array<Point, 2>> gradient_;  ///< of the subcells, as Subcell::gradient
};

}  // namespace sprekk::matrix_flow
