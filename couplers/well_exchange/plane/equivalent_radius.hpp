// The radius at which the pressure of a discretization is that of a well in the continuum.
#pragma once

#include <optional>

#include "components/capabilities/fluid_fluxes.hpp"
#include "framework/discretization/plane/point_source.hpp"

namespace sprekk::couplers {

/// The radius r_e (m) at which the pressure of a line source q in unbounded rock of one mobility M,
///   p = −q/(2 pi sqrt(det M)) ln rho,  rho^2 = sqrt(det M) x·M^-1 x,
/// equals the discrete pressure at the point of the source. This is Peaceman's radius (1978, 1983), found by his
/// method: the discrete equations are solved in a patch of cells around the point, with this pressure prescribed around
/// the patch (WellPatch). So it is right for any shape of cells, any anisotropy and any discretization with unknowns on
/// cells. On squares with the two-point flux it is 0.198 h in the middle of a cell. Returns nothing if a cell of the
/// source touches the boundary or a fracture. Throws std::invalid_argument, with the reason, for a discretization with
/// unknowns on faces, and for one with nonlinear fluxes.
std::optional<double> equivalent_radius(const Mesh& mesh, const MatrixFluxes& fluxes, const PointSource& source,
                                        const Tensor& mobility);

/// The radius of the circle that replaces a bore hole (m) in the metric of rho, in which it is an ellipse: Peaceman
/// 1983, r_w ((k_1/k_2)^(1/4) + (k_2/k_1)^(1/4))/2.
double radius_of_bore_hole(double radius, const Tensor& mobility);

}  // namespace sprekk::couplers
