// Injection where nothing stores fluid, neither rock nor compression: it has to open the fracture, and while walls
// stick nothing determines the constant mode of the pressure.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

constexpr double load = 20e6, modulus = 10e9, ratio = 0.25, half_length = 1, injected = 1e-3;

SceneRun injection(double angle) {
  return SceneRun::from_text(fmt::format(R"(
geometry:
  box: {{x: [-20 m, 20 m], y: [-20 m, 20 m]}}
  fractures: {{main: {{center: [0.3 m, -0.2 m], length: 2 m, angle: {0} deg}}}}
mesh: {{size: 5 m, fracture_size: 0.1 m, growth: 0.25}}
materials:
  young_modulus: {1} Pa
  poisson_ratio: {2}
  biot_coefficient: 0
  permeability: 1e-18 m^2
  viscosity: 1 mPa*s
  fluid_compressibility: 0 1/Pa
  friction: 0.6
components:
  pore: {{type: matrix_flow/mpfa, storage: 0 1/Pa, initial_pressure: 0 Pa}}
  rock:
    type: poromechanics/mpsa
    boundary:
      left: {{displacement_x: 0 m}}
      bottom: {{displacement_y: 0 m}}
      right: {{normal_stress: {3} Pa}}
      top: {{normal_stress: {3} Pa}}
  conduit:
    type: fracture_flow/tpfa
    initial_aperture: 0.1 mm
    initial_pressure: 0 Pa
    injection: {{first: {{fracture: main, rate: {4} m^2/s}}}}
  contact: {{type: contact/coulomb}}
couplers:
  - {{type: biot, between: [pore, rock]}}
  - {{type: wall_exchange, between: [pore, conduit]}}
  - {{type: wall_traction, between: [rock, contact, conduit]}}
  - {{type: aperture, between: [contact, conduit]}}
schedule: [{{solve: [pore, rock, conduit, contact]}}]
time: {{end: 1000 s, step: 250 s}}
)",
                                         angle, modulus, ratio, -load, injected / 1000));
}

// Sneddon: a crack with the excess pressure p over the load across it has the volume 2 pi (1 - nu^2) b^2 p / E.
TEST(NowhereToGo, InjectedFluidOpensTheFracture) {
  for (const double angle : {0.0, 37.0}) {
    SCOPED_TRACE(angle);
    SceneRun run = injection(angle);
    run.run();
    EXPECT_EQ(run.steps(), 4);
    double volume = 0, length = 0, mean = 0;
    for (int i = 0; i < run.mesh().fracture_cell_count(); ++i) {
      const double cell = run.mesh().fracture_cells[i].measure;
      length += cell;
      volume += cell * run.field("contact.jump")[2 * i];
      mean += cell * run.field("conduit.pressure")[i];
    }
    EXPECT_NEAR(volume, injected, 1e-8 * injected);
    const double excess = injected * modulus / (2 * std::numbers::pi * (1 - ratio * ratio) * half_length * half_length);
    EXPECT_NEAR(mean / length - load, excess, 0.03 * excess);
    EXPECT_NEAR(run.quantity("fluid_balance_error"), 0, 1e-8 * injected);
  }
}

}  // namespace
}  // namespace sprekk::testing
