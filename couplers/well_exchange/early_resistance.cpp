#include "couplers/well_exchange/early_resistance.hpp"

#include <cmath>

#include "framework/dense/least_squares.hpp"
#include "framework/invariants.hpp"
#include "framework/types.hpp"

namespace sprekk::couplers {
namespace {

constexpr double first_scale = 0.25;  // over r_w^2: at earlier times the storage near the bore hole is already filled
constexpr double last_scale = 64;  // over the area of the cell: from then on the mesh is late by 2e-3 of ln r at most
constexpr int samples_of_a_term = 2;    // more change the fit by a tenth of its error
constexpr double beyond_the_terms = 4;  // samples reach beyond first and last scale by this factor

}  // namespace

EarlyResistance fit_early_terms(double log_of_radii, double bore, double area,
                                const std::function<double(double decay)>& difference) {
  SPREKK_EXPECT(bore > 0 && area > 0, bore, area);
  EarlyResistance early;
  early.log_of_radii = log_of_radii;
  const double first = first_scale * bore * bore, last = last_scale * area;
  if (!(early.log_of_radii > 0 && first < last)) return early;
  for (int k = 0; k < early_terms; ++k)
    early.scales[k] = first * std::pow(last / first, static_cast<double>(k) / (early_terms - 1));
  const int samples = samples_of_a_term * early_terms;
  const double longest = beyond_the_terms * last, shortest = first / beyond_the_terms;
  Eigen::MatrixXd terms(samples, early_terms);
  Vector missing(samples);
  for (int i = 0; i < samples; ++i) {
    const double decay = std::pow(longest / shortest, static_cast<double>(i) / (samples - 1)) / longest;
    missing[i] = difference(decay) - early.log_of_radii;
    for (int k = 0; k < early_terms; ++k) terms(i, k) = decay * early.scales[k] / (1 + decay * early.scales[k]);
  }
  const Vector weights = solve_by_pivoted_qr(terms, missing);
  for (int k = 0; k < early_terms; ++k) early.weights[k] = weights[k];
  return early;
}

}  // namespace sprekk::couplers
