#include "couplers/well_exchange/plane/equivalent_radius.hpp"

#include <cmath>

#include "couplers/well_exchange/plane/well_patch.hpp"
#include "framework/discretization/principal_axes.hpp"

namespace sprekk::couplers {

std::optional<double> equivalent_radius(const Mesh& mesh, const MatrixFluxes& fluxes, const PointSource& source,
                                        const Tensor& mobility) {
  const WellPatch patch(mesh, fluxes, source, mobility);
  if (patch.is_empty()) return std::nullopt;
  return std::exp(-patch.steady_pressure());
}

double radius_of_bore_hole(double radius, const Tensor& mobility) {
  const Point values = principal_axes(mobility).values;
  const double root = std::sqrt(std::sqrt(values[1] / values[0]));
  return radius * (root + 1 / root) / 2;
}

}  // namespace sprekk::couplers
