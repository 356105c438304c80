// Fluid at rest under gravity in fractures with open ends.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

/// A fracture from `from` to `to` in a square of 1 m, with a pressure where it ends on a side.
void expect_rest(const Point& from, const Point& to, const char* side, const Point& end, const Point& gravity) {
  SceneRun run = SceneRun::from_text(fmt::format(
      R"(
geometry: {{box: {{x: [0 m, 1 m], y: [0 m, 1 m]}}, fractures: {{f: {{points: [[{}, {}], [{}, {}]]}}}}}}
mesh: {{size: 0.2 m, fracture_size: 0.1 m}}
components:
  conduit: {{type: fracture_flow/tpfa, viscosity: 1 mPa*s, initial_aperture: 1 mm, fluid_compressibility: 4e-10 1/Pa,
    transmissivity: constant, transmissivity_value: 1e-10 m^3, gravity: [{} m/s^2, {} m/s^2], fluid_density: 1000 kg/m^3,
    initial_pressure: 0 Pa, boundary: {{{}: {{pressure: 300 Pa}}}}}}
schedule: [{{solve: conduit}}]
time: {{end: 100 s, step: 10 s}}
)",
      from.x(), from.y(), to.x(), to.y(), gravity.x(), gravity.y(), side));
  run.run();
  const Vector& pressure = run.field("conduit.pressure");
  for (int i = 0; i < pressure.size(); ++i)
    EXPECT_NEAR(pressure[i], 300 + 1000 * gravity.dot(run.mesh().fracture_cells[i].center - end), 1e-4) << side;
}

TEST(OpenEndGravity, FluidAtRestHasThePressureOfItsColumn) {
  const Point g(0, -10);
  expect_rest({0.5, 0.2}, {0.5, 1}, "top", {0.5, 1}, g);
  expect_rest({0.5, 1}, {0.5, 0.2}, "top", {0.5, 1}, g);
  expect_rest({0.5, 0.8}, {0.5, 0}, "bottom", {0.5, 0}, g);
}

TEST(OpenEndGravity, AlsoForAnInclinedFractureAndAnyDirectionOfGravity) {
  const Point g(3, -10);
  expect_rest({0.31, 0.22}, {0.63, 1}, "top", {0.63, 1}, g);
  expect_rest({1, 0.71}, {0.31, 0.22}, "right", {1, 0.71}, g);
  expect_rest({0.7, 0.6}, {0, 0.13}, "left", {0, 0.13}, g);
}

}  // namespace
}  // namespace sprekk::testing
