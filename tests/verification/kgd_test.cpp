// The KGD fracture in the toughness regime against its closed form, over time.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

constexpr double plane_modulus = 32e9, toughness = 1e6, rate = 1e-4;

/// l = (E' Q t/(2 sqrt(pi) K_IC))^(2/3): K_I = p sqrt(pi l) and the volume 2 pi l^2 p/E' = Q t.
double half_length(double time) {
  return std::pow(plane_modulus * rate * time / (2 * std::sqrt(M_PI) * toughness), 2. / 3);
}

TEST(Kgd, LengthPressureAndOpeningFollowTheClosedForm) {
  EXPECT_NEAR(half_length(100), 20.123, 0.001);
  // The error of K_I with cells of 0.5 m on a fracture of 15 m, in this box: 0.8 % in the pressure, a third of that in
  // the length at a given volume.
  constexpr double start = 15;
  SceneRun run("verification/kgd.yaml", {{"geometry.fractures.main.points", "[[0 m, 0 m], [15 m, 0 m]]"}});
  double first = 0;
  run.run_until(74, [&] {
    const double grown = run.quantity("tips.main_last.length");
    const double expected = std::max(start, half_length(run.time()));
    const double pressure =
        grown > 0 ? toughness / std::sqrt(M_PI * expected)
                  : plane_modulus * rate * run.time() / (2 * M_PI * start * start);  // not yet at the toughness
    EXPECT_NEAR((start + grown) / expected, 1, 0.004) << run.time();
    EXPECT_NEAR(run.quantity("pressure") / pressure, 1, 0.01) << run.time();
    EXPECT_NEAR(run.quantity("opening.n") / (4 * pressure * expected / plane_modulus), 1, 0.004) << run.time();
    EXPECT_NEAR(run.quantity("fluid_balance_error"), 0, 1e-9 * run.quantity("fluid_injected"));
    if (grown > 0 && first == 0) first = run.time();
  });
  EXPECT_GT(run.mesh_changes(), 4);
  EXPECT_NEAR(first / 64.34, 1, 0.02);
  // The path is straight, although nothing prescribes its direction.
  for (const FractureCell& cell : run.mesh().fracture_cells)
    EXPECT_NEAR(cell.center[1], 0, cell.grown ? 0.01 * (cell.center[0] - start) : 1e-12);
}

/// The fracture's own opening conducts, and begins with nothing or next to nothing in cells that have grown. With a
/// viscosity of 1e-6 Pa s 12 mu E'^3 Q/(4 sqrt(2/pi) K_IC)^4 = 4e-4: the toughness regime still.
class KgdByTheCubicLaw : public ::testing::TestWithParam<std::string> {};

TEST_P(KgdByTheCubicLaw, OpensIntoCellsThatAreClosed) {
  // The fracture grows by 1.67 m, in increments of 0.25 m. Each is worth 2.1 % of the length and, as the volume stays,
  // 4.2 % of the pressure and 2.1 % of the opening, which is read once the rock has settled around the longer fracture
  // and the fluid has not yet.
  constexpr double start = 12, due = 46.05, end = 56;
  EXPECT_NEAR(half_length(due), start, 1e-3);
  SceneRun run("verification/kgd.yaml", {{"geometry.fractures.main.points", "[[0 m, 0 m], [12 m, 0 m]]"},
                                         {"components.conduit.transmissivity", "cubic_law"},
                                         {"components.conduit.transmissivity_value", "null"},
                                         {"components.conduit.viscosity", "1e-6 Pa*s"},
                                         {"components.conduit.grown.aperture", GetParam()},
                                         {"schedule.1.update", "after_step"},
                                         {"time.step", "2 s"}});
  run.run_until(20);  // the fluid loses pressure along the fracture while it hardly is open
  double first = 0, last = 0, longest = 0;
  run.run_until(end, [&] {
    const double grown = run.quantity("tips.main_last.length");
    const double expected = std::max(start, half_length(run.time()));
    const double pressure = grown > 0 ? toughness / std::sqrt(M_PI * expected)
                                      : plane_modulus * rate * run.time() / (2 * M_PI * start * start);
    EXPECT_NEAR((start + grown) / expected, 1, 0.015) << run.time();
    EXPECT_NEAR(run.quantity("pressure") / pressure, 1, grown > 0 ? 0.03 : 0.01) << run.time();
    EXPECT_NEAR(run.quantity("opening.n") / (4 * pressure * expected / plane_modulus), 1, grown > 0 ? 0.025 : 0.003)
        << run.time();
    EXPECT_NEAR(run.quantity("fluid_balance_error"), 0, 1e-9 * run.quantity("fluid_injected"));
    // No suction anywhere, and no more than one pressure: it is less in narrow cells at the tip only.
    EXPECT_GT(run.field("conduit.pressure").minCoeff(), 0) << run.time();
    EXPECT_LT(run.field("conduit.pressure").maxCoeff(), 1.05 * pressure) << run.time();
    if (grown > longest) last = run.time();
    if (grown > 0 && first == 0) first = run.time();
    longest = grown;
  });
  EXPECT_GT(run.mesh_changes(), 5);
  EXPECT_NEAR(first / due, 1, 0.03);
  EXPECT_GT(last, end - 3);  // an increment takes 1.5 s
}

/// The volume of the fluid is that of the fracture: what has been injected, and what it had at first. The fluid is as
/// good as incompressible. A cell that has grown has room of its own in the first case, and covers the one before it,
/// which was shorter, in the second one; neither makes fluid.
class KgdVolume : public ::testing::TestWithParam<std::string> {};

TEST_P(KgdVolume, IsWhatHasBeenInjected) {
  const bool within = GetParam() == "within_step";
  std::vector<Override> settings = {{"geometry.fractures.main.points", "[[0 m, 0 m], [2.5 m, 0 m]]"},
                                    {"mesh.size", "40 m"},
                                    {"components.rock.initial_stress.xx", "-20 MPa"},
                                    {"components.rock.boundary.right.normal_stress", "-20 MPa"},
                                    {"components.conduit.transmissivity", "cubic_law"},
                                    {"components.conduit.transmissivity_value", "null"},
                                    {"components.conduit.fluid_compressibility", "1e-13 1/Pa"},
                                    {"components.conduit.initial_aperture", "1 um"},
                                    {"components.conduit.injection.well.rate", "0.5e-3 m^2/s"},
                                    {"components.conduit.grown.fluid", "drawn"},
                                    {"components.conduit.grown.aperture", within ? "0 m" : "0.1 mm"},
                                    {"components.tips.toughness", "5.6 MPa*m^0.5"},
                                    {"components.tips.growth.increment", "0.5 m"},
                                    {"time.step", "0.15 s"}};
  settings.push_back({"schedule.1.update", GetParam()});
  if (within) {
    settings.push_back(
        {"couplers",
         "[{type: wall_traction, between: [rock, contact, conduit]}, {type: aperture, between: [contact, conduit]}, "
         "{type: two_level, between: [rock, conduit, tips], propagation_threshold: 0.25}]"});
  }
  SceneRun run("verification/kgd.yaml", settings);
  constexpr double before = 2.5 * 1e-6;
  run.run_until(3.6, [&] {
    double volume = 0;
    const Vector aperture = run.field("conduit.aperture");
    for (int i = 0; i < run.mesh().fracture_cell_count(); ++i)
      volume += run.mesh().fracture_cells[i].measure * aperture[i];
    const double injected = 0.5e-3 * run.time();
    EXPECT_NEAR((volume - before) / injected, 1, 1e-5) << run.time();
  });
  EXPECT_GT(run.quantity("tips.main_last.length"), 0.6);
  EXPECT_GT(run.mesh_changes(), 1);
}

INSTANTIATE_TEST_SUITE_P(Kgd, KgdVolume, ::testing::Values("within_step", "after_step"));

INSTANTIATE_TEST_SUITE_P(Kgd, KgdByTheCubicLaw, ::testing::Values("0 m", "1 um"));

}  // namespace
}  // namespace sprekk::testing
