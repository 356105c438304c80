#include "components/fracture_flow/tpfa/junction_fluxes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace sprekk::fracture_flow {
namespace {

Junction junction_of(int cells) {
  Junction junction;
  for (int i = 0; i < cells; ++i) junction.cells.push_back(10 + i);
  for (int k = 0; k < cells * (cells - 1) / 2; ++k) junction.ridges.push_back(100 + k);
  return junction;
}

/// Fluxes from i to j, i < j, in the order of the points, by the rows of parts and conductances.
std::vector<double> fluxes(const JunctionFluxes& at, const std::vector<double>& potentials) {
  const int count = static_cast<int>(potentials.size());
  std::vector<double> known(count * (count - 1) / 2);
  for (const bool wants_parts : {false, true}) {
    int place = 0;
    for (int i = 0; i < count; ++i)
      for (int j = i + 1; j < count; ++j, ++place) {
        const JunctionFluxes::Flux flux = at.flux(place);
        if (flux.parts.empty() == wants_parts) continue;
        if (!wants_parts) known[place] = flux.conductance.value * (potentials[i] - potentials[j]);
        for (const auto& part : flux.parts) known[place] += part.share.value * known[part.ridge - 100];
      }
  }
  return known;
}

TEST(JunctionFluxes, AreThoseThroughAStarOfResistances) {
  // Whichever conducts best: what leaves a cell is its conductance times its drop to the pressure of the junction.
  const std::vector<double> potentials = {3, -1, 0.5, 2};
  for (const std::vector<double>& conductances :
       {std::vector<double>{4, 1, 2, 3}, {1, 4, 2, 3}, {1, 2, 4, 3}, {1, 2, 3, 4}, {1, 1, 1, 1}, {0, 2, 1e-9, 1e9}}) {
    std::vector<JunctionFluxes::Half> halves;
    double sum = 0, weighted = 0;
    for (int i = 0; i < 4; ++i) {
      halves.push_back({conductances[i], Vector::Zero(4)});
      sum += conductances[i];
      weighted += conductances[i] * potentials[i];
    }
    const Junction junction = junction_of(4);
    const std::vector<double> known = fluxes(JunctionFluxes(junction, 4, halves), potentials);
    int place = 0;
    std::vector<double> out(4);
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j, ++place) {
        out[i] += known[place];
        out[j] -= known[place];
      }
    for (int i = 0; i < 4; ++i)
      EXPECT_NEAR(out[i], conductances[i] * (potentials[i] - weighted / sum), 1e-15 * (1 + conductances[i]) * 8)
          << i << " of " << conductances[0];
  }
}

TEST(JunctionFluxes, AreNoneWhereNothingConducts) {
  const Junction junction = junction_of(3);
  const JunctionFluxes at(junction, 3, {{0, Vector::Unit(3, 0)}, {0, Vector::Unit(3, 1)}, {0, Vector::Unit(3, 2)}});
  for (int place = 0; place < 3; ++place) {
    EXPECT_EQ(at.flux(place).conductance.value, 0);
    EXPECT_TRUE(at.flux(place).parts.empty());
  }
}

/// Of a factor by the aperture of each cell.
std::map<int, double> derivatives(const Conductance& factor) {
  std::map<int, double> all;
  for (const auto& [cell, by] : factor.by_aperture) all[cell] += by;
  return all;
}

TEST(JunctionFluxes, HaveTheDerivativesOfTheirFactors) {
  // Half conductances that go with the cube of apertures, the last one with the cube of a mean of two; central
  // differences.
  const std::vector<double> apertures = {1.1, 0.7, 1.3, 0.2};
  const Junction junction = junction_of(4);
  const auto at = [&](std::vector<double> a) {
    std::vector<JunctionFluxes::Half> halves;
    for (int i = 0; i < 4; ++i) {
      Vector weights = Vector::Unit(4, i);
      if (i == 3) weights << 0.25, 0, 0, 0.75;
      double mean = 0;
      for (int k = 0; k < 4; ++k) mean += weights[k] * a[k];
      halves.push_back({(i + 1) * mean * mean * mean, 3 * (i + 1) * mean * mean * weights});
    }
    return JunctionFluxes(junction, 4, halves);
  };
  constexpr double step = 1e-5;
  for (int place = 0; place < 6; ++place) {
    const JunctionFluxes::Flux flux = at(apertures).flux(place);
    for (int cell = 0; cell < 4; ++cell) {
      std::vector<double> more = apertures, less = apertures;
      more[cell] += step;
      less[cell] -= step;
      const JunctionFluxes::Flux up = at(more).flux(place), down = at(less).flux(place);
      EXPECT_NEAR(derivatives(flux.conductance)[10 + cell],
                  (up.conductance.value - down.conductance.value) / (2 * step), 1e-8);
      ASSERT_EQ(up.parts.size(), flux.parts.size());
      for (std::size_t k = 0; k < flux.parts.size(); ++k)
        EXPECT_NEAR(derivatives(flux.parts[k].share)[10 + cell],
                    (up.parts[k].share.value - down.parts[k].share.value) / (2 * step), 1e-8);
    }
  }
}

}  // namespace
}  // namespace sprekk::fracture_flow
