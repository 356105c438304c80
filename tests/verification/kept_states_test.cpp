// Of several solutions of a step the one in which nothing slides that friction holds.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

/// A fracture in nearly incompressible rock, under a load that goes to and fro. Slip opens it by dilation, and its
/// fluid, which cannot leave and nothing can replace in so short a time, sucks its walls together: they hold all of the
/// load that comes back. Walls that had slid back, beyond the place where they began, would be at rest, too.
SceneRun under_suction(bool is_mirrored, double load) {
  const std::string fixed = is_mirrored ? "right" : "left", loaded = is_mirrored ? "left" : "right";
  return SceneRun::from_text(fmt::format(
      "{{geometry: {{box: {{x: [0, 10], y: [0, 7]}}, fractures: {{main: {{points: {}}}}}}}, "
      "mesh: {{size: 1, fracture_size: 0.35, growth: 1.6}}, "
      "materials: {{young_modulus: 1.3 GPa, poisson_ratio: 0.4996, biot_coefficient: 0.7, permeability: 2.0e-12 m^2, "
      "viscosity: 4.0e-3 Pa*s, fluid_compressibility: 1.0e-10 1/Pa, friction: 1.4, dilation_angle: 17 deg}}, "
      "components: {{pore: {{type: matrix_flow/mpfa, storage: 0 1/Pa, boundary: {{{}: {{pressure: 0 Pa}}}}}}, "
      "rock: {{type: poromechanics/mpsa, boundary: {{{}: {{displacement_x: 0}}, bottom: {{displacement_y: 0}}, "
      "{}: {{normal_stress: '(-1e7 * {:.10f} * cos(6.283185307179586 * t / 8e-6)) Pa'}}, top: {{normal_stress: -1.5 "
      "MPa}}}}}}, "
      "conduit: {{type: fracture_flow/tpfa, initial_aperture: 0.015 mm}}, contact: {{type: contact/coulomb}}}}, "
      "couplers: [{{type: biot, between: [pore, rock]}}, {{type: wall_exchange, between: [pore, conduit]}}, "
      "{{type: wall_traction, between: [rock, contact, conduit]}}, {{type: aperture, between: [contact, conduit]}}], "
      "schedule: [{{solve: [pore, rock, conduit, contact]}}], time: {{end: 1.2e-5 s, step: 4e-6 s}}}}",
      is_mirrored ? "[[3, 2.8], [0.2, 4.2]]" : "[[7, 2.8], [9.8, 4.2]]", loaded, fixed, loaded, load));
}

class KeptStates : public ::testing::TestWithParam<std::tuple<bool, double>> {};

// From the state in which walls have climbed to that at the end of the step tractions are linear in the load, as long
// as all cells stick. The cone of friction is convex: what is in it at both ends is in it all along, so nothing makes
// the walls slide.
TEST_P(KeptStates, StickAsLongAsFrictionHoldsThem) {
  SceneRun run = under_suction(std::get<0>(GetParam()), std::get<1>(GetParam()));
  run.run_until(8e-6);
  const Vector climbed = run.field("contact.jump");
  const double slip = climbed.lpNorm<Eigen::Infinity>();
  for (int i = 0; i < climbed.size() / 2; ++i) EXPECT_GT(std::abs(climbed[2 * i + 1]), 0.5 * slip);
  run.run();
  EXPECT_LT((run.field("contact.jump") - climbed).lpNorm<Eigen::Infinity>(), 1e-8 * slip);
  const Vector traction = run.field("contact.traction");
  for (int i = 0; i < traction.size() / 2; ++i) {
    EXPECT_LT(traction[2 * i], 0);
    EXPECT_LT(std::abs(traction[2 * i + 1]), -1.4 * traction[2 * i]);
  }
}

INSTANTIATE_TEST_SUITE_P(, KeptStates,
                         ::testing::Values(std::tuple(false, 1.0), std::tuple(false, 1 + 1e-9), std::tuple(true, 1.0),
                                           std::tuple(false, 0.97)),
                         [](const auto& info) {
                           return std::string(std::get<0>(info.param) ? "mirrored" : "as_drawn") + "_" +
                                  std::to_string(info.index);
                         });

}  // namespace
}  // namespace sprekk::testing
