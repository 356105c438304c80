#include "couplers/well_exchange/plane/early_resistance.hpp"

#include <cmath>

#include "couplers/well_exchange/plane/well_patch.hpp"
#include "framework/invariants.hpp"

namespace sprekk::couplers {
namespace {

/// s times the Laplace transform of the pressure of a bore hole of the radius r in infinite rock, times 2 pi sqrt(det
/// M)/q, with x = r sqrt(s/c).
double bore_hole(double x) { return std::cyl_bessel_k(0.0, x) / (x * std::cyl_bessel_k(1.0, x)); }

}  // namespace

std::optional<EarlyResistance> early_resistance(const Mesh& mesh, const MatrixFluxes& fluxes, const PointSource& source,
                                                const Tensor& mobility, double bore) {
  SPREKK_EXPECT(bore > 0, bore);
  const WellPatch patch(mesh, fluxes, source, mobility);
  if (patch.is_empty()) return std::nullopt;
  double area = 0;
  for (const auto& [cell, share] : source.shares) area += share * mesh.cell_measure[cell];
  return fit_early_terms(-patch.steady_pressure() - std::log(bore), bore, area, [&](double decay) {
    return bore_hole(bore * std::sqrt(decay)) - patch.transformed_pressure(decay);
  });
}

}  // namespace sprekk::couplers
