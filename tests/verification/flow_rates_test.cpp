// What history.csv says of rates: of wells, of sides, and of places in fractures whose pressure is prescribed.
#include <gtest/gtest.h>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

/// Reference: steady flow along a column, k/mu times the height times the gradient, in at one side and out at the
/// other.
TEST(FlowRates, SidesOfAColumnHaveThatOfDarcysLaw) {
  SceneRun run = SceneRun::from_text(R"(
geometry: {box: {x: [0 m, 2 m], y: [0 m, 0.7 m]}}
mesh: {size: 0.2 m}
components:
  pore: {type: matrix_flow/mpfa, permeability: 1e-14 m^2, viscosity: 1 mPa*s, storage: 0 1/Pa, boundary: {left: {pressure: 3 MPa}, right: {pressure: 1 MPa}, top: {flux: 0 m/s}}}
schedule: [{solve: pore}]
time: {end: 1 s, step: 1 s}
)");
  run.run();
  const double exact = 1e-14 / 1e-3 * 0.7 * 2e6 / 2;
  EXPECT_NEAR(run.quantity("pore.right.outflow"), exact, 1e-9 * exact);
  EXPECT_NEAR(run.quantity("pore.left.outflow"), -exact, 1e-9 * exact);
  EXPECT_NEAR(run.quantity("pore.top.outflow"), 0, 1e-12 * exact);
}

/// Rock and two crossing fractures, in which one place has a rate and two have pressures, between sides with pressures.
std::string network(double compressibility, double steps) {
  return R"(
geometry:
  box: {x: [0 m, 2 m], y: [0 m, 1 m]}
  fractures:
    long: {points: [[0.2 m, 0.3 m], [2 m, 0.7 m]]}
    short: {points: [[0.8 m, 0.8 m], [1.2 m, 0.2 m]]}
mesh: {size: 0.25 m, fracture_size: 0.1 m}
materials: {viscosity: 1 mPa*s, fluid_compressibility: )" +
         std::to_string(compressibility) + R"( 1/GPa, porosity: 0.1}
components:
  pore:
    type: matrix_flow/mpfa
    permeability: 1e-13 m^2
    boundary: {left: {pressure: 0.5 MPa}, top: {flux: 1e-6 m/s}}
    wells: {feed: {at: [0.5 m, 0.8 m], rate: 2e-5 m^2/s}}
  conduit:
    type: fracture_flow/tpfa
    initial_aperture: 0.1 mm
    boundary: {right: {pressure: 1 MPa}}
    injection: {well: {fracture: long, at: [0.5 m, 0.37 m], rate: 3e-5 m^2/s}}
    prescribed:
      low: {fracture: short, at: [1.19 m, 0.22 m], pressure: 0.1 MPa}
      high: {fracture: short, at: [0.81 m, 0.78 m], pressure: 2 MPa}
couplers: [{type: wall_exchange, between: [pore, conduit]}]
schedule: [{solve: [pore, conduit]}]
time: {end: 100 s, step: )" +
         std::to_string(steps) + " s}\n";
}

/// Reference: what enters in a step is stored or leaves. In a steady flow all rates add up to nothing.
TEST(FlowRates, OfAllPlacesAndSidesAreWhatIsStored) {
  for (const double compressibility : {1.0, 1e-6}) {
    SceneRun run = SceneRun::from_text(network(compressibility, 20));
    double stored = 0;
    for (int step = 0; step < 5; ++step) {
      ASSERT_TRUE(run.step());
      const double now = run.quantity("fluid_stored");
      const double in = run.quantity("pore.feed.rate") + run.quantity("conduit.well.rate") +
                        run.quantity("conduit.low.rate") + run.quantity("conduit.high.rate");
      const double out =
          run.quantity("pore.left.outflow") + run.quantity("pore.top.outflow") + run.quantity("conduit.right.outflow");
      EXPECT_NEAR(in - out, (now - stored) / 20, 1e-12);
      EXPECT_NEAR(run.quantity("pore.feed.rate"), 2e-5, 1e-17);
      EXPECT_NEAR(run.quantity("conduit.well.rate"), 3e-5, 1e-17);
      EXPECT_NEAR(run.quantity("pore.top.outflow"), 2e-6, 1e-16);
      EXPECT_LT(run.quantity("conduit.low.rate"), -1e-6);
      EXPECT_GT(run.quantity("conduit.high.rate"), 1e-6);
      stored = now;
    }
  }
}

}  // namespace
}  // namespace sprekk::testing
