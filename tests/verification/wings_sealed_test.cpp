// Wings in sealed rock under a prescribed pressure: critical pressures as functions of the length of the wing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

struct Wing {
  double onset = 0;                      ///< Pa, at the end of the first step with growth
  std::vector<double> length, pressure;  ///< m, Pa; where it has grown
  double pressure_at(double wanted) const {
    std::size_t i = 1;
    while (i + 1 < length.size() && length[i] < wanted) ++i;
    return pressure[i - 1] + (wanted - length[i - 1]) / (length[i] - length[i - 1]) * (pressure[i] - pressure[i - 1]);
  }
};

/// To 9.2 MPa, where the wing is about 2.5 mm long. A tenth of an hour is 0.1 MPa.
Wing grow(const std::string& increment, const std::string& fracture_size) {
  SceneRun run("verification/wings_sealed.yaml", {{"components.tips.growth.increment", increment},
                                                  {"mesh.fracture_size", fracture_size},
                                                  {"time.step", "0.1 h"},
                                                  {"time.start", "7.9 h"}});
  Wing wing;
  run.run_until(9.2 * 3600, [&] {
    const double length = run.quantity("tips.main_last.length"), pressure = run.quantity("fracture_pressure");
    if (length == 0) return;
    if (wing.onset == 0) wing.onset = pressure;
    // From the first increment on the direction leaves no K_II, and so nothing that could alternate.
    EXPECT_LT(std::abs(run.quantity("tips.main_last.K_II")), 0.0101 * run.quantity("tips.main_last.K_I")) << pressure;
    // A tip waits until it can grow by 0.1 mm. At 0.5 mm that is worth 0.05 MPa, or 2 % of K_I; the tolerance is 1 %.
    if (length > 0.5e-3) {
      EXPECT_NEAR(run.quantity("tips.main_last.K_I"), 0.7e6, 0.03 * 0.7e6) << pressure;
    }
    wing.length.push_back(length);
    wing.pressure.push_back(pressure);
  });
  return wing;
}

TEST(WingsInSealedRock, CriticalPressuresDependOnNeitherIncrementNorMesh) {
  const Wing coarse = grow("10 mm", "10 mm"), fine = grow("5 mm", "5 mm");
  // D sqrt(pi b) = 0.601 MPa m^0.5 at 8.06 MPa; the factors are right to 1 %, which is worth 0.03 MPa, and a step is
  // 0.1 MPa.
  for (const Wing& wing : {coarse, fine}) {
    EXPECT_GT(wing.onset, 8.02e6);
    EXPECT_LT(wing.onset, 8.2e6 + 1e3);
  }
  for (const double length : {0.5e-3, 1e-3, 2e-3})
    EXPECT_NEAR(coarse.pressure_at(length) / fine.pressure_at(length), 1, 0.01) << length;
  EXPECT_TRUE(std::is_sorted(fine.length.begin(), fine.length.end()));
}

/// K_II at the right tip when it has grown, with the paper's rule, Pa m^0.5.
std::vector<double> explicit_shear(const std::string& increment, int count) {
  SceneRun run("verification/wings_sealed.yaml",
               {{"components.tips.growth", "{increment: " + increment + ", direction: explicit, length: fixed}"},
                {"time.step", "0.05 h"},
                {"time.start", "8 h"}});
  std::vector<double> shear;
  double length = 0;
  while (static_cast<int>(shear.size()) < count && run.step()) {
    const double now = run.quantity("tips.main_last.length");
    if (now > length) shear.push_back(run.quantity("tips.main_last.K_II"));
    length = now;
  }
  return shear;
}

TEST(WingsInSealedRock, TheExplicitRuleAlternatesBeyondTheLimitOfItsIncrement) {
  // 0.17 (K_I/T)^2 = 0.8 mm, by the theory of slightly curved cracks (docs/numerics/growth.md).
  const std::vector<double> below = explicit_shear("0.3 mm", 12), beyond = explicit_shear("1.5 mm", 6);
  ASSERT_EQ(below.size(), 12u);
  ASSERT_EQ(beyond.size(), 6u);
  for (std::size_t i = 1; i < below.size(); ++i) {
    EXPECT_LT(below[i], 0) << i;  // no swing around zero
    EXPECT_LT(std::abs(below[i]), 0.05 * 0.7e6) << i;
  }
  for (std::size_t i = 1; i < beyond.size(); ++i) {
    EXPECT_LT(beyond[i] * beyond[i - 1], 0) << i;
    EXPECT_GT(std::abs(beyond[i]), 0.1 * 0.7e6) << i;
  }
  EXPECT_GT(std::abs(beyond.back()), std::abs(beyond.front()));  // it does not fade
  EXPECT_LT(std::abs(below.back()), std::abs(below[1]));         // it does
}

/// Mesh, stress and boundary conditions are point-symmetric; rollers on two sides only, as in section 5.2 of the paper,
/// are not.
SceneRun symmetric_run(const std::string& length, const std::string& start, const std::string& step = "0.1 h",
                       const std::string& outputs = "[]") {
  const std::string held = "displacement: [0 m, 0 m]";
  return SceneRun(
      "verification/wings_sealed.yaml",
      {{"geometry.box", "{x: [-0.4 m, 0.4 m], y: [-0.4 m, 0.4 m]}"},
       {"geometry.fractures.main.length", length},
       {"mesh", "{kind: structured, cells: [32, 32], size: null, fracture_size: null, growth: null}"},
       {"components.rock.boundary", "{left: {" + held + ", displacement_x: null}, right: {" + held +
                                        ", normal_stress: null}, bottom: {" + held + ", displacement_y: null}, top: {" +
                                        held + ", normal_stress: null}}"},
       {"components.tips.size", "0.31 m"},
       {"components.tips.skip_below", "0"},
       {"components.tips.cavity", "2"},
       {"time.start", start},
       {"time.step", step},
       {"output.times", outputs}});
}

TEST(WingsInSealedRock, BothTipsFeelTheSameOnASymmetricMesh) {
  SceneRun run = symmetric_run("0.14142135623730950488 m", "6.9 h");
  ASSERT_TRUE(run.step());
  const Vector& jump = run.field("contact.jump");
  const long count = jump.size() / 2;
  ASSERT_LT(jump.minCoeff(), -1e-6);
  for (long i = 0; i < count; ++i)
    for (int k = 0; k < 2; ++k)
      EXPECT_NEAR(jump[2 * i + k], jump[2 * (count - 1 - i) + k], 1e-12 * jump.cwiseAbs().maxCoeff()) << i;
  // The meshes of the two fine levels are images of one another.
  EXPECT_NEAR(run.quantity("tips.main_first.K_eq") / run.quantity("tips.main_last.K_eq"), 1, 1e-9);
}

void expect_equal_wings(SceneRun run) {
  run.run_until(11 * 3600, [&] {
    const double first = run.quantity("tips.main_first.length"), last = run.quantity("tips.main_last.length");
    EXPECT_NEAR(first, last, 1e-9 * first) << "at " << run.time() << " s";
  });
  EXPECT_GT(run.quantity("tips.main_last.length"), 0.1);
  EXPECT_GE(run.mesh_changes(), 2);
}

// The cavities around the tips are apart, so that each is filled for itself.
TEST(WingsInSealedRock, BothTipsGrowAlikeOnASymmetricMesh) {
  expect_equal_wings(symmetric_run("0.28284271247461900976 m", "6.6 h"));
}

// In these steps the tips pass a place at which round-off would choose the topology of a fine level.
TEST(WingsInSealedRock, NoTipLeadsByRoundOff) {
  expect_equal_wings(
      symmetric_run("0.28284271247461900976 m", "6.6 h", "0.12 h", "[6.93 h, 7.26 h, 7.59 h, 7.92 h, 8.25 h, 8.58 h]"));
}

}  // namespace
}  // namespace sprekk::testing
