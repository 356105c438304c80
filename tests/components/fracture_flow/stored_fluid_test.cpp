// The fluid that a cell of a fracture stores: a function of its state where nothing enters, exact for walls that yield
// linearly, and derivatives.
#include "components/fracture_flow/tpfa/stored_fluid.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sprekk::fracture_flow {
namespace {

constexpr double initial = 1e-3, compressibility = 1e-7;  // m, 1/Pa

StoredFluid stored(double after, double change, EnteringDensity density = EnteringDensity::of_step) {
  return stored_fluid(initial, after, change, compressibility, density);
}

TEST(StoredFluid, KeepsItsMassWhereNothingEnters) {
  for (const double e : {-5.0, -0.7, -1e-2, -3e-3, -1e-9, 1e-9, 3e-3, 1e-2, 0.7, 5.0}) {
    const double after = initial * std::exp(-e);
    EXPECT_NEAR(stored(after, e / compressibility).volume, 0,
                1e-15 * initial * (1 + std::abs(e)) * std::exp(std::abs(e)))
        << e;
  }
}

TEST(StoredFluid, IsTheSameInOneStepAndInMany) {
  // The walls yield linearly to the pressure, in both directions.
  const double change = 7.7e6, after = 3.3e-3;
  for (const int steps : {1, 3, 10}) {
    double filled = 0, emptied = 0;
    const auto at = [&](int k) { return initial + (after - initial) * k / steps; };
    for (int k = 0; k < steps; ++k) {
      filled += stored_fluid(at(k), at(k + 1), change / steps, compressibility, EnteringDensity::of_step).volume;
      emptied += stored_fluid(at(k + 1), at(k), -change / steps, compressibility, EnteringDensity::of_step).volume;
    }
    const double exact = after - initial + compressibility * change * (after + initial) / 2;  // int da + a c dp
    EXPECT_NEAR(filled, exact, 1e-14 * exact) << steps;
    EXPECT_NEAR(emptied, -exact, 1e-14 * exact) << steps;
  }
}

TEST(StoredFluid, OfRigidWallsIsCompressibilityTimesPressure) {
  for (const double change : {-3e7, -1e3, 1e3, 3e7})
    EXPECT_NEAR(stored(initial, change).volume, initial * compressibility * change,
                1e-15 * std::abs(initial * compressibility * change));
}

TEST(StoredFluid, IsNothingWhereOnlyTheCompressibilityChanges) {
  EXPECT_EQ(stored_fluid(initial, initial, 0, 1e-3, EnteringDensity::of_step).volume, 0);
  EXPECT_EQ(stored_fluid(initial, initial, 0, 1e-3, EnteringDensity::at_end).volume, 0);
}

TEST(StoredFluid, HasTheDerivativesOfItsDifferences) {
  for (const EnteringDensity density : {EnteringDensity::of_step, EnteringDensity::at_end})
    for (const double opening : {-4e-4, 5e-4, 2e-3})
      for (const double change : {-2e7, -5e4, 3e4, 6e6, 1e8}) {
        const double after = initial + opening, da = 1e-6 * initial, dp = 1e-6 * std::abs(change);
        const StoredFluid here = stored(after, change, density);
        const double by_aperture =
            (stored(after + da, change, density).volume - stored(after - da, change, density).volume) / (2 * da);
        const double by_pressure =
            (stored(after, change + dp, density).volume - stored(after, change - dp, density).volume) / (2 * dp);
        EXPECT_NEAR(here.by_aperture, by_aperture, 1e-7 * (1 + std::abs(by_aperture))) << opening << " " << change;
        EXPECT_NEAR(here.by_pressure, by_pressure, 1e-6 * compressibility * (initial + after))
            << opening << " " << change;
      }
}

/// Two branches meet where one of both changes is zero, and the series of B the function.
TEST(StoredFluid, IsContinuous) {
  for (const double e : {-0.5, 0.5}) {
    const double change = e / compressibility;
    EXPECT_NEAR(stored(initial * (1 + 1e-12), change).volume, stored(initial * (1 - 1e-12), change).volume,
                1e-11 * initial);
  }
  for (const double x : {-1e-2, 1e-2}) {
    const Bernoulli series(x * (1 - 1e-9)), function(x * (1 + 1e-9));
    EXPECT_NEAR(series.value, function.value, 2e-11);
    EXPECT_NEAR(series.derivative, function.derivative, 1e-11);
  }
  EXPECT_EQ(Bernoulli(0).value, 1);
  EXPECT_NEAR(Bernoulli(1).value, 1 / (std::exp(1.0) - 1), 1e-15);
  for (const double x : {-1e4, 1e4}) EXPECT_TRUE(std::isfinite(Bernoulli(x).value + Bernoulli(x).derivative)) << x;
}

}  // namespace
}  // namespace sprekk::fracture_flow
