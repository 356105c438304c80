// How far tips that grow together advance (Eq. 13 of the paper).
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "framework/invariants.hpp"

namespace sprekk::fine_fracture {

/// The lengths l_max (G_i/max G)^exponent, m, for the energy release rates G_i >= 0 of the tips that grow; l_max for a
/// single tip. The exponent of the paper is 0.35. All lengths are 0 when no tip releases energy.
inline std::vector<double> increment_lengths(const std::vector<double>& energy_release_rates, double l_max,
                                             double exponent) {
  std::vector<double> lengths(energy_release_rates.size(), 0.0);
  SPREKK_EXPECT(l_max > 0, l_max);
  if (lengths.empty()) return lengths;
  const double largest = *std::max_element(energy_release_rates.begin(), energy_release_rates.end());
  if (!(largest > 0)) return lengths;
  for (std::size_t i = 0; i < lengths.size(); ++i)
    lengths[i] = l_max * std::pow(std::max(0.0, energy_release_rates[i]) / largest, exponent);
  return lengths;
}

}  // namespace sprekk::fine_fracture
