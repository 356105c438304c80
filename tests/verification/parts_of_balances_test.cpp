// What one part of a balance receives from another, where other rows of the same equation exchange many times as much.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/balance_error.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

// Along the fracture heat is conducted, in a step, of whose round-off all that the fluid brings is a part: the rock
// takes it up all the same. Found by tools/stress --family heat --seed 611 --only 111.
TEST(PartsOfBalances, HeatOfAFractureThatConductsManyTimesAsMuchReachesTheRock) {
  SceneRun run = SceneRun::from_text(R"(
geometry:
  box: {x: [0 m, 10 m], y: [0 m, 10 m]}
  fractures: {main: {points: [[3 m, 5 m], [7 m, 5 m]]}}
mesh: {size: 1 m, fracture_size: 0.5 m}
materials: {permeability: 1e-20 m^2, viscosity: 1e-3 Pa*s, fluid_compressibility: 1e-10 1/Pa}
components:
  pore: {type: matrix_flow/mpfa, storage: 1e-7 1/Pa}
  conduit: {type: fracture_flow/tpfa, initial_aperture: 3 mm, injection: {first: {fracture: main, rate: 2e-23 m^2/s}}}
  heat: {type: matrix_heat/tpfa, conductivity: 1 W/(m*K), heat_capacity: 5e6 J/(m^3*K), initial_temperature: 580 K}
  water: {type: fracture_heat/tpfa, aperture: 3 mm, conductivity: 10 W/(m*K), heat_capacity: 1e4 J/(m^3*K), initial_temperature: 580 K}
couplers:
  - {type: wall_exchange, between: [pore, conduit]}
  - {type: heat_advection, between: [pore, conduit, heat, water], fluid_heat_capacity: 1e4 J/(m^3*K), injected: {first: {temperature: 550 K}}}
  - {type: heat_exchange, between: [heat, water], conductance: 2e4 W/(m^2*K)}
schedule: [{solve: [pore, conduit, heat, water]}]
time: {end: 4e18 s, step: 2e18 s}
)");
  for (int n = 0; n < 2; ++n) {
    ASSERT_TRUE(run.step());
    EXPECT_LE(run.iterations(), 4);  // 36, as long as the sum of the fracture was to hold to more digits than its rows
  }
  const double brought = 1e4 * 2e-23 * 4e18 * (580 - 550), capacity = 5e6 * 100;
  const double colder = 580 - run.field("heat.temperature").mean();
  constexpr double digits = 1e-13 * 580;  // of a temperature
  EXPECT_NEAR(colder, brought / capacity, 10 * digits);
}

// Two wells exchange 1e13 times as much through one fracture as passes the other one. There nothing more is stored from
// the third step on, and what enters leaves. Found by tools/stress --family wells --seed 612 --only 228.
TEST(PartsOfBalances, SteadyFlowThroughAFractureLosesNothingBesideWellsThatExchangeMore) {
  SceneRun run = SceneRun::from_text(R"(
geometry:
  box: {x: [0, 2.2332888068189], y: [0, 1.737919877410571]}
  fractures:
    main: {points: [[2.2263369938529913, 0.807006545105046], [1.9270413008472533, 0.9309133323055251]]}
    other: {points: [[2.1691369981461674, 0.8382110374947239], [1.9895595823427243, 0.9125551098150114]]}
mesh: {size: 0.23109998059693362, fracture_size: 0.02159534968111112, growth: 1.8198032837072156}
materials:
  young_modulus: 24.24 GPa
  poisson_ratio: 0.27
  biot_coefficient: 0.255
  permeability: 4.14e-21 m^2
  viscosity: 0.001 Pa*s
  fluid_compressibility: 1e-9 1/Pa
  friction: 1.87
components:
  pore: {type: matrix_flow/mpfa, storage: 3e-9 1/Pa}
  rock:
    type: poromechanics/mpsa
    boundary:
      left: {displacement_x: 0}
      bottom: {displacement_y: 0}
      right: {normal_stress: -3.9 MPa}
      top: {normal_stress: -1.4 MPa}
  conduit: {type: fracture_flow/tpfa, initial_aperture: 5 mm}
  contact: {type: contact/coulomb}
  wells:
    type: wells/limited
    wells:
      weak: {at: [2.1869493567500764 m, 0.8233128123948562 m], fracture: main, index: 3.36e-18 m^2/(Pa*s), pressure: -475 kPa}
      strong: {at: [2.123608315091474 m, 0.8495356587413243 m], fracture: main, pressure: 36.2 kPa}
      small: {at: [2.0033138886354327 m, 0.8993368962753593 m], fracture: main, rate: 8e-21 m^2/s, highest_pressure: 1.2 MPa}
couplers:
  - {type: biot, between: [pore, rock]}
  - {type: wall_exchange, between: [pore, conduit]}
  - {type: wall_traction, between: [rock, contact, conduit]}
  - {type: aperture, between: [contact, conduit]}
  - {type: well_exchange, between: [wells, pore, conduit]}
schedule: [{solve: [pore, rock, conduit, contact, wells]}]
time: {end: 8e15 s, step: 1.6e15 s}
)");
  for (int n = 0; n < 5; ++n) {
    ASSERT_TRUE(run.step());
    if (n < 2) continue;
    const Vector& flux = run.field("pore.wall_flux");
    double net = 0, gross = 0;
    for (int i = 0; i < run.mesh().fracture_cell_count(); ++i) {
      const FractureCell& cell = run.mesh().fracture_cells[i];
      if (run.mesh().fractures[cell.fracture].name != "other") continue;
      net += cell.measure * (flux[2 * i] + flux[2 * i + 1]);
      gross += cell.measure * (std::abs(flux[2 * i]) + std::abs(flux[2 * i + 1]));
    }
    EXPECT_GT(gross, 0);
    EXPECT_LE(std::abs(net), 1e-8 * gross) << n;
  }
}

}  // namespace
}  // namespace sprekk::testing
