// Walls without friction that open as they slip, and fluid that cannot follow: only the load determines in which
// direction they are about to slide.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

constexpr double rate = 1.8e-5, injects_until = 0.034, end = 0.067;

struct Twin {
  std::string name;
  double across = 1;  ///< −1: mirrored from left to right
  double upward = 1;  ///< −1: mirrored from bottom to top
  double load = 1;
};

/// Two fractures that cross, in rock that is nearly undrained in these steps, under a load that shears both.
SceneRun cross(const Twin& twin) {
  const auto at = [&](double x, double y) { return fmt::format("[{}, {}]", twin.across * x, twin.upward * y); };
  const bool is_mirrored = twin.across < 0, is_upside_down = twin.upward < 0;
  return SceneRun::from_text(fmt::format(
      "{{geometry: {{box: {{x: [-3.8, 3.8], y: [-5.8, 5.8]}}, fractures: {{main: {{points: [{}, {}]}}, "
      "other: {{points: [{}, {}]}}}}}}, mesh: {{size: 1.2, fracture_size: 0.2, growth: 1.4}}, "
      "materials: {{young_modulus: 3.3 GPa, poisson_ratio: 0.486, biot_coefficient: 0.96, permeability: 3.4e-15 m^2, "
      "viscosity: 2.2e-3 Pa*s, fluid_compressibility: 1.3e-9 1/Pa, friction: 0, dilation_angle: 2 deg}}, "
      "components: {{pore: {{type: matrix_flow/mpfa, storage: 6.0e-11 1/Pa, boundary: {{{}: {{pressure: 0 Pa}}}}}}, "
      "rock: {{type: poromechanics/mpsa, boundary: {{{}: {{displacement_x: 0}}, {}: {{displacement_y: 0}}, "
      "{}: {{normal_stress: {} Pa}}, {}: {{normal_stress: -2.2 MPa}}}}}}, "
      "conduit: {{type: fracture_flow/tpfa, initial_aperture: 5.2 um, injection: {{first: {{fracture: main, rate: "
      "{{value: {} m^2/s, from: 0, to: {} s}}}}}}}}, contact: {{type: contact/coulomb}}}}, "
      "couplers: [{{type: biot, between: [pore, rock]}}, {{type: wall_exchange, between: [pore, conduit]}}, "
      "{{type: wall_traction, between: [rock, contact, conduit]}}, {{type: aperture, between: [contact, conduit]}}], "
      "schedule: [{{solve: [pore, rock, conduit, contact]}}], time: {{end: {} s, step: 0.0096 s}}}}",
      at(-1.75, -0.02), at(1.75, 0.02), at(-1.28, 0.32), at(0.84, -0.13), is_mirrored ? "left" : "right",
      is_mirrored ? "right" : "left", is_upside_down ? "top" : "bottom", is_mirrored ? "left" : "right",
      -18.8e6 * twin.load, is_upside_down ? "bottom" : "top", rate, injects_until, end));
}

class FrictionlessCross : public ::testing::TestWithParam<Twin> {};

// If round-off gave the direction of friction, and cells were taken to slide back, steps would be cut without end.
TEST_P(FrictionlessCross, TakesItsStepsWithoutCut) {
  SceneRun run = cross(GetParam());
  const double tangent = std::tan(2 * M_PI / 180);
  run.run_until(end, [&] {
    EXPECT_LE(run.iterations(), 8);
    const Vector &jump = run.field("contact.jump"), &traction = run.field("contact.traction");
    const double largest = jump.lpNorm<Eigen::Infinity>(), load = traction.lpNorm<Eigen::Infinity>();
    ASSERT_GT(largest, 1e-3);
    for (int i = 0; i < run.mesh().fracture_cell_count(); ++i) {
      const double gap = jump[2 * i] - std::abs(jump[2 * i + 1]) * tangent;
      EXPECT_NEAR(traction[2 * i + 1], 0, 1e-9 * load);
      EXPECT_LE(traction[2 * i], 1e-9 * load);
      EXPECT_GE(gap, -1e-9 * largest);
      EXPECT_TRUE(gap < 1e-9 * largest || traction[2 * i] > -1e-9 * load) << gap << " " << traction[2 * i];
    }
  });
  // Seven steps of 9.6 ms, and one that ends where the injection does.
  EXPECT_EQ(run.steps(), 8);
  EXPECT_NEAR(run.quantity("fluid_injected"), rate * injects_until, 1e-9 * rate * injects_until);
  EXPECT_LT(std::abs(run.quantity("fluid_balance_error")), 1e-6 * rate * injects_until);
}

INSTANTIATE_TEST_SUITE_P(, FrictionlessCross,
                         ::testing::Values(Twin{"as_drawn"}, Twin{"mirrored", -1}, Twin{"upside_down", 1, -1},
                                           Twin{"turned", -1, -1}, Twin{"nearby", 1, 1, 1 + 1e-9},
                                           Twin{"less", 1, 1, 0.97}),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace sprekk::testing
