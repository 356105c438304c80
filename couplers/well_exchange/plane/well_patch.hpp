// The cells around a well, and the discrete equations of the flow in them.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "couplers/well_exchange/patch_of_cells.hpp"
#include "framework/discretization/plane/point_source.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::couplers {

/// One flag a cell: whether it touches neither a side nor a fracture.
std::vector<char> inner_cells(const Mesh& mesh);

/// Up to `most_layers` layers of cells around the cells of a point source, in rock of one mobility M; with rho, the
/// distance in the metric rho^2 = sqrt(det M) x·M^-1 x. Pressures p are those of a source of the rate q times 2 pi
/// sqrt(det M)/q.
class WellPatch {
 public:
  /// Empty where one of the source's cells touches the boundary or a fracture. Throws std::invalid_argument as
  /// PatchOfCells does.
  WellPatch(const Mesh& mesh, const MatrixFluxes& fluxes, const PointSource& source, const Tensor& mobility);

  bool is_empty() const { return !cells_; }
  /// The pressure at the point of a constant source in steady flow, with the pressures −ln rho of a line source in the
  /// cells around the patch.
  double steady_pressure() const;
  /// s times the Laplace transform, at s = c·`decay`, of the pressure at the point of a source that begins at the time
  /// 0, with the diffusivity c (`decay` in 1/m^2). The cells around the patch have that of a line source, K_0(rho
  /// sqrt(decay)).
  double transformed_pressure(double decay) const;

 private:
  template <class Source>
  double pressure(double decay, const Source& source) const;

  std::optional<PatchOfCells> cells_;
  std::vector<std::pair<int, double>> source_;  ///< indices in the patch, and shares
  double size_;                                 ///< sqrt(det M)
  Point at_;
  Tensor inverse_;  ///< sqrt(det M) M^-1
};

}  // namespace sprekk::couplers
