// Cracks that have slipped and are loaded less.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

/// A crack of 0.1 m under 15 MPa across and 5 MPa along it, at 45 degrees to both, with a friction of 0.5, whose fluid
/// has 12 MPa in the first second and another pressure in the second one.
std::string scene(double pressure, double angle, int cells, double dilation, const char* type = "coulomb") {
  const double c = std::cos(2 * (angle - 45) * M_PI / 180), s = std::sin(2 * (angle - 45) * M_PI / 180);
  const double xx = -15e6 - 5e6 * c, yy = -15e6 + 5e6 * c, xy = -5e6 * s;
  return fmt::format(
      "{{geometry: {{box: {{x: [-4 m, 4 m], y: [-4 m, 4 m]}}, fractures: {{main: {{center: [0 m, 0 m], length: 0.1 m, "
      "angle: {0} deg}}}}}}, mesh: {{size: 1 m, fracture_size: {1:.17g} m, growth: 0.3}}, components: {{rock: {{type: "
      "poromechanics/mpsa, young_modulus: 40 GPa, poisson_ratio: 0.2, initial_stress: {{xx: {2:.17g} Pa, yy: {3:.17g} "
      "Pa, xy: {4:.17g} Pa}}, boundary: {{left: {{displacement_x: 0 m, traction_y: {5:.17g} Pa}}, bottom: "
      "{{displacement_y: 0 m, traction_x: {5:.17g} Pa}}, right: {{traction: [{2:.17g} Pa, {4:.17g} Pa]}}, top: "
      "{{traction: [{4:.17g} Pa, {3:.17g} Pa]}}}}}}, conduit: {{type: fracture_flow/tpfa, viscosity: 1.0e-4 Pa*s, "
      "fluid_compressibility: 4.0e-10 1/Pa, initial_aperture: 1 mm, prescribed: {{everywhere: {{fracture: main, "
      "pressure: '(12e6 + ({6:.17g} * 1e6 - 12e6) * max(0, t - 1)) Pa'}}}}}}, contact: {{type: contact/{8}, "
      "friction: 0.5, dilation_angle: {7} deg}}}}, couplers: [{{type: wall_traction, between: [rock, contact, "
      "conduit]}}], schedule: [{{solve: [rock, conduit, contact]}}], time: {{end: 2 s, step: 1 s}}}}",
      angle, 0.1 / cells * (1 + 1e-9), xx, yy, xy, -xy, pressure, dilation, type);
}

class Unloading : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Angles, Unloading, ::testing::Values(0, 20, 45, 110),
                         [](const auto& info) { return fmt::format("{:.0f}", info.param); });

// Friction holds what has slipped: no cell moves when the pressure falls, however fine the crack is divided. The slip
// under 12 MPa leaves the walls a shear stress of 1.5 MPa, and every pressure below 12 MPa gives them more friction
// than that.
TEST_P(Unloading, SticksAtOnce) {
  for (const int cells : {10, 40})
    for (const double dilation : {0.0, 2.0}) {
      SceneRun run = SceneRun::from_text(scene(2, GetParam(), cells, dilation));
      ASSERT_TRUE(run.step());
      const Vector slipped = run.field("contact.jump");
      const double drop = (5e6 - 0.5 * 3e6) / (1 + 0.5 * std::tan(dilation * M_PI / 180));
      EXPECT_NEAR(slipped.lpNorm<Eigen::Infinity>() / (4 / (40e9 / 0.96) * drop * 0.05), 1, 0.03);
      ASSERT_TRUE(run.step());
      EXPECT_LE(run.iterations(), 6) << cells << " " << dilation;
      EXPECT_EQ(run.quantity("contact.cells_stick"), cells);
      EXPECT_LT((run.field("contact.jump") - slipped).lpNorm<Eigen::Infinity>(),
                1e-9 * slipped.lpNorm<Eigen::Infinity>());
    }
}

// With springs between the walls, too: the stiffness of the springs is that of the answer, and not that by which a cell
// is told to stick.
TEST_P(Unloading, SticksSoonWithSprings) {
  for (const char* type : {"augmented_lagrangian", "penalty"})
    for (const double dilation : {0.0, 2.0}) {
      SceneRun run = SceneRun::from_text(scene(2, GetParam(), 40, dilation, type));
      ASSERT_TRUE(run.step());
      const Vector slipped = run.field("contact.jump");
      ASSERT_TRUE(run.step());
      RecordProperty(fmt::format("{}_{}", type, dilation), run.iterations());
      EXPECT_LE(run.iterations(), 10) << type << " " << dilation;
      EXPECT_EQ(run.quantity("contact.cells_stick"), 40);
      // Elastic slip is that of springs a hundred times as stiff as the rock.
      const double elastic = type == std::string("penalty") ? 0.02 : 1e-9;
      EXPECT_LT((run.field("contact.jump") - slipped).lpNorm<Eigen::Infinity>(),
                elastic * slipped.lpNorm<Eigen::Infinity>());
    }
}

}  // namespace
}  // namespace sprekk::testing
