// Walls that slide back over their asperities while the fluid between them cannot leave.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

/// A block with a fracture full of stiff fluid, compressed, and sheared to the right, not, to the left, not, in four
/// steps. Slip opens the fracture by dilation, which the fluid resists. It flows so well that its pressure is uniform.
SceneRun sheared_to_and_fro(const std::string& cells = "[8, 8]", const std::string& newton = "{}") {
  return SceneRun::from_text(
      "{geometry: {box: {x: [0, 1], y: [0, 1]}, fractures: {main: {points: [[0.25, 0.5], [0.75, 0.5]]}}}, "
      "mesh: {kind: structured, cells: " +
      cells + "}, newton: " + newton +
      ", "
      "components: {"
      "rock: {type: poromechanics/mpsa, young_modulus: 10 GPa, poisson_ratio: 0.2, boundary: {"
      "bottom: {displacement: [0 m, 0 m]}, "
      "top: {displacement_x: '(0.002 * sin(6.283185307179586 * t)) m', displacement_y: -0.5 mm}}}, "
      "conduit: {type: fracture_flow/tpfa, viscosity: 1.0e-3 Pa*s, fluid_compressibility: 4.0e-11 1/Pa, "
      "initial_aperture: 0.01 mm, transmissivity: constant, transmissivity_value: 1.0e-10 m^3}, "
      "contact: {type: contact/coulomb, friction: 0.4, dilation_angle: 15 deg}}, "
      "couplers: [{type: wall_traction, between: [rock, contact, conduit]}, "
      "{type: aperture, between: [contact, conduit]}], "
      "schedule: [{solve: [rock, conduit, contact]}], time: {end: 1 s, step: 0.25 s}}");
}

/// The state under shear to the left is that under shear to the right, mirrored: it fulfils all conditions, with slip
/// the other way. Between the two there is no state at rest, so smaller steps are of no help.
void expect_mirrored_state_in_one_step(SceneRun run) {
  ASSERT_TRUE(run.step());
  const Vector right = run.field("contact.jump"), held = run.field("contact.traction");
  ASSERT_TRUE(run.step());
  ASSERT_TRUE(run.step());
  EXPECT_EQ(run.steps(), 3);
  EXPECT_DOUBLE_EQ(run.time(), 0.75);
  const Vector left = run.field("contact.jump"), held_back = run.field("contact.traction");
  const double slip = right.lpNorm<Eigen::Infinity>(), force = held.lpNorm<Eigen::Infinity>();
  ASSERT_GT(slip, 0);
  const int cells = static_cast<int>(right.size()) / 2;
  // Ten times what Newton's method may leave.
  for (int i = 0; i < cells; ++i) {
    EXPECT_NEAR(left[2 * i], right[2 * i], 1e-7 * slip);
    EXPECT_NEAR(left[2 * i + 1], -right[2 * i + 1], 1e-7 * slip);
    EXPECT_NEAR(held_back[2 * i], held[2 * i], 1e-7 * force);
    EXPECT_NEAR(held_back[2 * i + 1], -held[2 * i + 1], 1e-7 * force);
  }
}

TEST(BackSlip, ReachesTheMirroredStateInOneStep) {
  SceneRun run = sheared_to_and_fro();
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(run.step());
  EXPECT_LE(run.iterations(), 8);
  expect_mirrored_state_in_one_step(sheared_to_and_fro());
}

TEST(BackSlip, IsReachedOnAPathToo) {
  // Two iterations do not find it, so it is left to the path, here along 80 cells.
  expect_mirrored_state_in_one_step(sheared_to_and_fro("[160, 8]", "{at_most: 4, pieces: 1000}"));
}

}  // namespace
}  // namespace sprekk::testing
