// The fine level on a run of section 5.1: refined to a tolerance, and with an error that is known.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

struct Factors {
  double first, error;
};

Factors factors_after_loading(const std::vector<Override>& overrides) {
  SceneRun run("paper/onset.yaml", overrides);
  run.step();
  return {run.quantity("tips.main_first.K_II"), run.quantity("tips.main_first.K_error_fine_mesh")};
}

// Two ways to a finer mesh: one that is fine everywhere (four times), and one that the estimate makes from a coarse
// one.
TEST(FineLevel, RefinementToAToleranceFindsWhatAFineMeshFinds) {
  const Factors coarse = factors_after_loading({{"components.tips.mesh_ratio", "1"}});
  const Factors refined =
      factors_after_loading({{"components.tips.mesh_ratio", "1"}, {"components.tips.tolerance", "1e-4"}});
  const Factors fine = factors_after_loading({{"components.tips.mesh_ratio", "0.125"}});
  EXPECT_LT(std::abs(refined.first - fine.first), 2e-4 * std::abs(fine.first));
  EXPECT_LT(refined.error, 0.5 * coarse.error);
  EXPECT_LT(coarse.error, 1e-3 * std::abs(fine.first));
}

/// An open crack in rock whose Young's modulus changes, E(t) = E_0/(1 + t/h).
SceneRun softening(const std::string& top) {
  return SceneRun::from_text(
      "{geometry: {box: {x: [0 m, 2 m], y: [0 m, 2 m]}, fractures: {main: {center: [1 m, 1 m], length: 0.4 m, angle: "
      "30 "
      "deg}}}, mesh: {size: 0.3 m, fracture_size: 40 mm}, components: {rock: {type: poromechanics/mpsa, young_modulus: "
      "(40e9/(1 + t/h)) Pa, poisson_ratio: 0.2, boundary: {left: {displacement_x: 0 m}, bottom: {displacement_y: 0 m}, "
      "top: " +
      top +
      "}}, contact: {type: contact/coulomb, friction: 0.5}, tips: {type: fine_fracture/quarter_point, size: 0.3 m}}, "
      "couplers: [{type: wall_traction, between: [rock, contact]}, {type: two_level, between: [rock, tips]}], "
      "schedule: "
      "[{solve: [rock, contact]}, {grow: tips, settle: [rock, contact]}], time: {end: 3 h, step: 1 h}}");
}

// Where tractions are given the factors do not depend on the modulus; where displacements are, they are proportional.
TEST(FineLevel, TakesTheStiffnessOfItsTime) {
  for (const bool by_displacement : {false, true}) {
    SceneRun run = softening(by_displacement ? "{displacement_y: 0.1 mm}" : "{normal_stress: 1 MPa}");
    double first = 0;
    run.run_until(3 * 3600, [&] {
      const double factor = run.quantity("tips.main_first.K_I") * (by_displacement ? 1 + run.time() / 3600 : 1);
      if (first == 0) first = factor;
      EXPECT_NEAR(factor, first, 1e-9 * first) << run.time();
    });
    EXPECT_GT(first, 1e5);
  }
}

}  // namespace
}  // namespace sprekk::testing
