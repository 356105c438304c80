// The column of fluid that stands in a well between its places.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/balance_error.hpp"

namespace sprekk::testing {
namespace {

/// Fluid at rest in rock and fractures stays at rest, whichever way gravity points: a shut well that is open to rock
/// and fractures at several depths passes nothing on, and has the pressure of its highest place.
TEST(WellsWeight, FluidAtRestStaysAtRest) {
  for (const auto& [gx, gy] : {std::pair{0.0, -9.81}, {-9.81, 0.0}, {6.0, 7.0}}) {
    SceneRun run = SceneRun::from_text(fmt::format(R"(
geometry:
  box: {{x: [-50 m, 50 m], y: [-50 m, 50 m]}}
  fractures: {{a: {{points: [[-30 m, -20 m], [10 m, -34 m]]}}, b: {{points: [[-20 m, 8 m], [38 m, 30 m]]}}}}
mesh: {{size: 12 m, fracture_size: 6 m}}
materials: {{viscosity: 1 mPa*s, fluid_compressibility: 4e-10 1/Pa, gravity: [{0} m/s^2, {1} m/s^2]}}
components:
  pore:
    type: matrix_flow/mpfa
    permeability: 1e-14 m^2
    porosity: 0.1
    initial_pressure: "(10e6 + 1000*({0}*x + {1}*y)) Pa"
  conduit: {{type: fracture_flow/tpfa, initial_aperture: 0.2 mm, initial_pressure: "(10e6 + 1000*({0}*x + {1}*y)) Pa"}}
  wells:
    type: wells/limited
    wells:
      w:
        rate: 0 m^2/s
        places:
          low: {{at: [-10 m, -27 m], fracture: a}}
          high: {{at: [9 m, 19 m], fracture: b}}
          rock: {{at: [30 m, -10 m], index: 1e-11 m^2/(Pa*s)}}
couplers:
  - {{type: wall_exchange, between: [pore, conduit]}}
  - {{type: well_exchange, between: [wells, pore, conduit]}}
schedule: [{{solve: [pore, conduit, wells]}}]
time: {{end: 10 day, step: 1 day}}
)",
                                                   gx, gy));
    const Vector before = run.field("pore.pressure");
    run.run();
    for (const char* place : {"low", "high", "rock"})  // of what a difference of 100 kPa would drive
      EXPECT_LT(std::abs(run.quantity(fmt::format("wells.w.{}.rate", place))), 1e-9 * 1e-11 * 1e5) << place;
    EXPECT_LT((run.field("pore.pressure") - before).lpNorm<Eigen::Infinity>(), 1e-3);
    double least = 1e300;
    for (const Point& at : {Point(-10, -27), Point(9, 19), Point(30, -10)})
      least = std::min(least, 10e6 + 1000 * (gx * at[0] + gy * at[1]));
    EXPECT_NEAR(run.quantity("wells.w.pressure"), least, 1000 * 9.81 * 6);  // the middle of a cell
  }
}

/// Two sealed fractures that conduct well and a shut well through both: their pressures approach a difference of the
/// weight of the fluid between them, as backward Euler does with the time R C, R that of each place and C the storage.
TEST(WellsWeight, TwoFracturesFindTheirDifference) {
  SceneRun run = SceneRun::from_text(R"(
geometry:
  box: {x: [0 m, 10 m], y: [0 m, 100 m]}
  fractures: {low: {points: [[2 m, 20 m], [8 m, 20 m]]}, high: {points: [[2 m, 70 m], [8 m, 70 m]]}}
mesh: {kind: structured, cells: [10, 20], shape: quadrilaterals}
materials: {viscosity: 1 mPa*s, gravity: [0 m/s^2, -10 m/s^2], fluid_density: 900 kg/m^3}
components:
  conduit:
    type: fracture_flow/tpfa
    fluid_compressibility: 1e-9 1/Pa
    initial_aperture: 1 mm
    initial_pressure: 10 MPa
    law: {type: constant, transmissivity: 1e-3 m^3}
  wells:
    type: wells/limited
    wells:
      w:
        rate: 0 m^2/s
        places:
          a: {at: [4.5 m, 20 m], fracture: low, index: 1e-14 m^2/(Pa*s)}
          b: {at: [4.5 m, 70 m], fracture: high, index: 1e-14 m^2/(Pa*s)}
couplers: [{type: well_exchange, between: [wells, conduit]}]
schedule: [{solve: [conduit, wells]}]
time: {end: 3000 s, step: 100 s}
)");
  const double storage = 6 * 1e-3 * 1e-9, weight = 900 * 10 * 50;
  double left = 1;
  run.run_until(3000, [&] {
    left /= 1 + 100 / (storage / 1e-14);
    const Vector& p = run.field("conduit.pressure");
    EXPECT_NEAR(p[0] - p[6], weight * (1 - left), 1e-6 * weight);
    EXPECT_NEAR(p[0] + p[6], 20e6, 1);
    EXPECT_NEAR(run.quantity("wells.w.pressure"), 10e6 - weight / 2, 1);
  });
  EXPECT_LT(left, 0.01);
  EXPECT_LT(balance_error(run), 1e-9);
}

}  // namespace
}  // namespace sprekk::testing
