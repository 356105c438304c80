// The resistance of a well before the flow around it is steady on the scale of its cell.
#pragma once

#include <array>
#include <functional>

namespace sprekk::couplers {

/// The number of terms of a resistance that changes with time: the scales are a factor of 4 apart.
constexpr int early_terms = 12;

/// The difference of the pressures of a well and of the cells at its point after a rate q has begun at the time 0:
///   p_well − p_cell = q/(2 pi sqrt(det M)) (ln(r_e/r_w) + sum over k of weight_k exp(−c t/scale_k)),
/// with the diffusivity c in the metric of rho (WellPatch, LineField). A mesh does not resolve the flow within the cell
/// of the well: with the steady index alone the pressure is late by about h^2/(8 c) on squares. The terms replace the
/// response of the cell on the mesh by that of a bore hole in infinite rock, K_0(x)/(x K_1(x)), x = r_w sqrt(s/c) for
/// the transform at s (van Everdingen and Hurst 1949); Blanc et al. (1999) do the same with tables. They are a fit of
/// least squares to the transforms, and vanish when the flow is steady.
struct EarlyResistance {
  double log_of_radii = 0;                    ///< ln(r_e/r_w)
  std::array<double, early_terms> weights{};  ///< 1
  std::array<double, early_terms> scales{};   ///< m^2
};

/// `bore`: the radius of the bore hole in the metric of rho, m; `area`: of the cells across the well, m^2;
/// `difference`: of the transforms of the pressures of well and cells at s = c · decay, times s 2 pi sqrt(det M)/q.
/// Without terms where ln(r_e/r_w) is not positive, which the caller refuses.
EarlyResistance fit_early_terms(double log_of_radii, double bore, double area,
                                const std::function<double(double decay)>& difference);

}  // namespace sprekk::couplers
