#include "couplers/well_exchange/early_resistance.hpp"

#include <cmath>

#include "couplers/well_exchange/well_patch.hpp"
#include "framework/dense/least_squares.hpp"
#include "framework/invariants.hpp"

namespace sprekk::couplers {
namespace {

constexpr double first_scale = 0.25;  // over r_w^2: at earlier times the storage near the bore hole is already filled
constexpr double last_scale = 64;  // over the area of the cell: from then on the mesh is late by 2e-3 of ln r at most
constexpr int samples_of_a_term = 2;    // more change the fit by a tenth of its error
constexpr double beyond_the_terms = 4;  // samples reach beyond first and last scale by this factor

/// s times the Laplace transform of the pressure of a bore hole of the radius r in infinite rock, times 2 pi sqrt(det
/// M)/q, with x = r sqrt(s/c).
double bore_hole(double x) { return std::cyl_bessel_k(0.0, x) / (x * std::cyl_bessel_k(1.0, x)); }

}  // namespace

std::optional<EarlyResistance> early_resistance(const Mesh& mesh, const MatrixFluxes& fluxes, const PointSource& source,
                                                const Tensor& mobility, double bore) {
  SPREKK_EXPECT(bore > 0, bore);
  const WellPatch patch(mesh, fluxes, source, mobility);
  if (patch.is_empty()) return std::nullopt;
  EarlyResistance early;
  early.log_of_radii = -patch.steady_pressure() - std::log(bore);
  double area = 0;
  for (const auto& [cell, share] : source.shares) area += share * mesh.cell_measure[cell];
  const double first = first_scale * bore * bore, last = last_scale * area;
  if (!(early.log_of_radii > 0 && first < last)) return early;  // refused by the caller
  for (int k = 0; k < early_terms; ++k)
    early.scales[k] = first * std::pow(last / first, static_cast<double>(k) / (early_terms - 1));
  const int samples = samples_of_a_term * early_terms;
  const double longest = beyond_the_terms * last, shortest = first / beyond_the_terms;
  Eigen::MatrixXd terms(samples, early_terms);
  Vector missing(samples);
  for (int i = 0; i < samples; ++i) {
    const double decay = std::pow(longest / shortest, static_cast<double>(i) / (samples - 1)) / longest;
    missing[i] = bore_hole(bore * std::sqrt(decay)) - patch.transformed_pressure(decay) - early.log_of_radii;
    for (int k = 0; k < early_terms; ++k) terms(i, k) = decay * early.scales[k] / (1 + decay * early.scales[k]);
  }
  const Vector weights = solve_by_pivoted_qr(terms, missing);
  for (int k = 0; k < early_terms; ++k) early.weights[k] = weights[k];
  return early;
}

}  // namespace sprekk::couplers
