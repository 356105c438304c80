// Rock and fractures whose walls conduct little or nothing, in steps in which each of them becomes uniform: what each
// holds determines its temperature.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/verification/balance_error.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

constexpr double step = 1e16, conductance_of_tight_walls = 1e-13;

std::string scene(double conductance, const std::string& solver, const std::string& boundary = "") {
  return fmt::format(R"(
geometry:
  box: {{x: [0 m, 4 m], y: [0 m, 3 m]}}
  fractures: {{f: {{points: [[1 m, 0.8 m], [3 m, 2.1 m]]}}}}
mesh: {{size: 1 m, fracture_size: 0.3 m}}
components:
  heat: {{type: matrix_heat/mpfa, conductivity: 3 W/(m*K), heat_capacity: 2e6 J/(m^3*K), initial_temperature: (300 + 10*x + 7*y) K{}}}
  water: {{type: fracture_heat/tpfa, aperture: 1 mm, conductivity: 0.6 W/(m*K), heat_capacity: 4e6 J/(m^3*K), initial_temperature: (400 + 5*x) K}}
couplers: [{{type: heat_exchange, between: [heat, water], conductance: {} W/(m^2*K)}}]
schedule: [{{solve: [heat, water]}}]
solver: {}
time: {{end: {} s, step: {} s}}
)",
                     boundary, conductance, solver, 3 * step, step);
}

const char* const solvers[] = {"{type: umfpack}", "{type: mumps}", "{type: umfpack, condense: false}"};

void expect_uniform(const Vector& values, double expected, double range) {
  EXPECT_NEAR(values.minCoeff(), expected, 1e-10 * range);
  EXPECT_NEAR(values.maxCoeff(), expected, 1e-10 * range);
}

/// Reference: two bodies of uniform temperature that exchange heat through walls of this conductance, by backward
/// Euler. The fracture stores 5e-11 of what is conducted along it in a step.
TEST(HeatAtRest, IsThatOfTwoBodies) {
  const double length = std::hypot(2, 1.3), of_rock = 2e6 * 12, of_fracture = 4e6 * 1e-3 * length;
  for (const char* solver : solvers)
    for (const double conductance : {0.0, conductance_of_tight_walls}) {
      SCOPED_TRACE(fmt::format("{} {}", solver, conductance));
      SceneRun run = SceneRun::from_text(scene(conductance, solver));
      double rock = 300 + 10 * 2 + 7 * 1.5, fracture = 400 + 5 * 2;
      const double passes = 2 * conductance * length * step;
      for (int n = 0; n < 3; ++n) {
        ASSERT_TRUE(run.step());
        const double held = of_rock * rock + of_fracture * fracture;
        fracture = (of_fracture * fracture + passes * held / of_rock) /
                   (of_fracture + passes + passes * of_fracture / of_rock);
        rock = (held - of_fracture * fracture) / of_rock;
        expect_uniform(run.field("heat.temperature"), rock, 100);
        expect_uniform(run.field("water.temperature"), fracture, 100);
      }
      EXPECT_LT(balance_error(run, "heat"), 1e-9);
    }
}

// A side holds the temperature of the rock, and not that of a fracture behind walls that conduct nothing.
TEST(HeatAtRest, OfAFractureIsItsOwnBesideAGivenSide) {
  for (const char* solver : solvers) {
    SCOPED_TRACE(solver);
    SceneRun run = SceneRun::from_text(scene(0, solver, ", boundary: {left: {temperature: 350 K}}"));
    run.run();
    EXPECT_EQ(run.steps(), 3);
    expect_uniform(run.field("heat.temperature"), 350, 100);
    expect_uniform(run.field("water.temperature"), 410, 100);
  }
}

}  // namespace
}  // namespace sprekk::testing
