// The integrals of boundary elements against quadratures of many points.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "components/fine_fracture/boundary_element/density_integrals.hpp"

namespace sprekk::fine_fracture {
namespace {

constexpr std::array densities{Density::polynomial, Density::root, Density::corner};

/// Trapezoidal rule in x with t = (1 + tanh(pi/2 sinh x))/2 (Takahasi and Mori 1974).
DensityIntegrals by_many_points(Density density, Complex w) {
  DensityIntegrals sum{};
  constexpr double step = 0.02;
  for (double x = -3.6; x <= 3.6; x += step) {
    const double inner = std::numbers::pi / 2 * std::sinh(x), t = 0.5 * (1 + std::tanh(inner));
    const double weight = step * std::numbers::pi / 4 * std::cosh(x) / std::pow(std::cosh(inner), 2);
    const auto values = densities_at(density, t);
    for (int j = 0; j < element_nodes; ++j) {
      const Complex kernel = 1.0 / (w - t);
      sum.value[j] += weight * values[j] * kernel;
      sum.slope[j] -= weight * values[j] * kernel * kernel;
      sum.curvature[j] += 2 * weight * values[j] * kernel * kernel * kernel;
    }
  }
  return sum;
}

TEST(DensityIntegrals, AreThoseOfManyPoints) {
  for (const Density density : densities)
    for (const Complex w : {Complex(0.3, 0.2), Complex(-0.2, 0.1), Complex(1.4, -0.1), Complex(-0.5, 0),
                            Complex(1.7, 0), Complex(0.5, 1.99), Complex(0.5, -2.01), Complex(30, 40)}) {
      const DensityIntegrals found = density_integrals(density, w), expected = by_many_points(density, w);
      for (int j = 0; j < element_nodes; ++j) {
        EXPECT_LT(std::abs(found.value[j] - expected.value[j]), 1e-10) << w;
        EXPECT_LT(std::abs(found.slope[j] - expected.slope[j]), 1e-9) << w;
        EXPECT_LT(std::abs(found.curvature[j] - expected.curvature[j]), 1e-8) << w;
      }
    }
}

TEST(DensityIntegrals, OnTheElementAreTheMeanOfBothSides) {
  for (const Density density : densities)
    for (const double t : element_places()) {
      constexpr double away = 1e-8;  // the mean differs by pi times it and the slope of the density
      const DensityIntegrals on = density_integrals_on(density, t), above = density_integrals(density, {t, away}),
                             below = density_integrals(density, {t, -away});
      for (int j = 0; j < element_nodes; ++j) {
        EXPECT_LT(std::abs(on.value[j] - 0.5 * (above.value[j] + below.value[j])), 1e-5);
        EXPECT_LT(std::abs(on.slope[j] - 0.5 * (above.slope[j] + below.slope[j])), 1e-4);
      }
    }
}

TEST(DensityIntegrals, AtATipAreTheLimitAlongTheElement) {
  const DensityIntegrals near = density_integrals_on(Density::root, 1e-10);
  const auto limit = slopes_at_tip();
  for (int j = 0; j < element_nodes; ++j) EXPECT_NEAR(near.slope[j].real(), limit[j], 1e-4);
}

TEST(DensityIntegrals, JumpsAreOneAtTheirNode) {
  for (const Density density : densities)
    for (int i = 0; i < element_nodes; ++i) {
      const auto values = densities_at(density, element_places()[i]);
      for (int j = 0; j < element_nodes; ++j) EXPECT_NEAR(values[j], i == j, 1e-12);
    }
}

}  // namespace
}  // namespace sprekk::fine_fracture
