// A wing that grows into another fracture and joins it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "framework/scene/plane/change_mesh.hpp"
#include "tests/verification/scene_run.hpp"
#include "tests/verification/values_of_paper.hpp"

namespace sprekk::testing {
namespace {

constexpr double mega = 1e6, hour = 3600;

/// What the longer fracture points to.
struct Other {
  std::string points = "[[0.12 m, -0.03 m], [0.13 m, 0.03 m]]", pressure = "(t/3600) MPa";
};

/// The scene joining.yaml, in which nothing grows.
SceneRun pressurized(const Other& other, const std::vector<Override>& more = {}) {
  std::vector<Override> overrides = {{"geometry.fractures.wall.points", other.points},
                                     {"components.conduit.prescribed.wall.pressure", '"' + other.pressure + '"'},
                                     {"components.conduit.transmissivity", "constant"},
                                     {"components.conduit.transmissivity_value", "1.0e-6 m^3"}};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return SceneRun("../tests/verification/scenes/joining.yaml", overrides);
}

SceneRun growing(const std::string& meeting, const Other& other = {}) {
  return pressurized(
      other,
      {{"components.tips",
        "{type: fine_fracture/quarter_point, size: 0.3 m, toughness: 0.7 MPa*m^0.5, growth: {increment: 10 mm}, "
        "meeting: " +
            meeting + "}"},
       {"couplers",
        "[{type: wall_traction, between: [rock, contact, conduit]}, {type: two_level, between: [rock, conduit, "
        "tips]}]"},
       {"schedule", "[{solve: [rock, conduit, contact]}, {grow: tips, settle: [rock, contact], update: after_step}]"}});
}

TEST(Joining, AnOpenFractureHasTheStateThatOneOfThisFormHas) {
  SceneRun run = growing("join");
  while (run.mesh().junctions.empty()) ASSERT_TRUE(run.step()) << run.time();
  // K_I = p sqrt(pi a) reaches the toughness at 1.61 MPa; the other fracture and the outline are worth a few percent.
  EXPECT_NEAR(run.time() / hour, 1.61, 0.08);
  ASSERT_EQ(run.mesh().junctions.size(), 1u);
  EXPECT_EQ(run.mesh().junctions[0].cells.size(), 3u);
  const int point = run.mesh().junctions[0].ridges[0];
  EXPECT_NEAR(run.mesh().ridges[point].center.y(), 0, 0.0051);  // half a cell of the other fracture
  EXPECT_EQ(run.quantity("tips.main_last.stopped"), 1);
  EXPECT_NEAR(run.quantity("tips.main_last.length"), 0.065, 0.002);
  EXPECT_EQ(run.quantity("tips.wall_last.stopped"), 0);

  // Without friction, and in elastic rock, a state does not depend on the way to it. The new cells are bonded until the
  // next step, which is made here without further growth.
  SceneRun without_growth = pressurized({});
  const Scene& scene = without_growth.model().scene();
  Model goes_on(scene, run.mesh()), fresh(scene, run.mesh());
  transfer_fields(run.model().fields(), no_change(run.mesh()), run.mesh(), run.mesh(), goes_on.fields());
  const double start = 1.4 * hour, dt = 60, end = run.time() + dt;
  ASSERT_TRUE(goes_on.attempt({run.time(), dt, end}).converged);
  ASSERT_TRUE(fresh.attempt({start, end - start, end}).converged);
  const Vector& grown = goes_on.fields().at("contact.jump").now();
  const Vector& at_once = fresh.fields().at("contact.jump").now();
  EXPECT_LT((grown - at_once).lpNorm<Eigen::Infinity>(), 1e-9 * at_once.lpNorm<Eigen::Infinity>());
  for (int i = 0; i < run.mesh().fracture_cell_count(); ++i) EXPECT_GT(grown[2 * i], 0) << i;
}

TEST(Joining, TipsThatFaceEachOtherMeet) {
  // Both grow towards each other, and one of them joins the other where that one is on the mesh.
  SceneRun run = growing("join", {.points = "[[0.095 m, 0 m], [0.215 m, 0 m]]"});
  double longest = 0;
  while (run.mesh().junctions.empty()) {
    ASSERT_TRUE(run.step()) << run.time();
    // Nothing that has grown is lost.
    const double length = run.quantity("tips.wall_first.length");
    EXPECT_GE(length, longest - 1e-12);
    longest = length;
  }
  EXPECT_EQ(run.mesh().junctions[0].cells.size(), 2u);
  EXPECT_EQ(run.quantity("tips.main_last.stopped"), 1);
  EXPECT_EQ(run.quantity("tips.wall_first.stopped"), 1);
  // Together they have grown by the distance between them.
  EXPECT_NEAR(run.quantity("tips.main_last.length") + run.quantity("tips.wall_first.length"), 0.035, 1e-3);
}

TEST(Joining, NoTipClosesARing) {
  // The other fracture, without fluid, has an arm before each tip.
  SceneRun run = growing(
      "join",
      {.points = "[[-0.12 m, 0.03 m], [-0.12 m, -0.2 m], [0.125 m, -0.2 m], [0.125 m, 0.03 m]]", .pressure = "0 MPa"});
  const auto are_stopped = [&] {
    return run.quantity("tips.main_first.stopped") + run.quantity("tips.main_last.stopped") == 2;
  };
  while (!are_stopped()) ASSERT_TRUE(run.step()) << run.time();
  ASSERT_TRUE(run.step());
  EXPECT_EQ(run.mesh().junctions.size(), 1u);
}

// The end of another fracture is so near to the way of a tip that the tip stops before it: it turns by up to 60 degrees
// to join it.
TEST(Joining, ATipTurnsToWhatItPassesCloselyUnlessThatIsBesideIt) {
  // Increments of 10 mm put the tip at 90 mm; the end is 7 mm above its way, seen at 54 and at 67 degrees.
  for (const auto& [x, joins] : {std::pair(95, true), {93, false}}) {
    const std::string points = "[[" + std::to_string(x) + " mm, 7 mm], [" + std::to_string(x) + " mm, 60 mm]]";
    SceneRun run = growing("join", {.points = points, .pressure = "0 MPa"});
    while (run.quantity("tips.main_last.stopped") == 0) ASSERT_TRUE(run.step()) << run.time();
    EXPECT_EQ(run.mesh().junctions.size(), joins ? 1u : 0u) << x;
    EXPECT_NEAR(run.quantity("tips.main_last.length"), joins ? 0.03 + std::hypot(0.005, 0.007) : 0.03, 1e-3) << x;
  }
}

TEST(Joining, ATipMayBeAskedToStopInstead) {
  SceneRun run = growing("stop");
  while (run.quantity("tips.main_last.stopped") == 0) ASSERT_TRUE(run.step()) << run.time();
  EXPECT_TRUE(run.mesh().junctions.empty());
  // One to two coarse edges before the other fracture.
  EXPECT_GT(run.quantity("tips.main_last.length"), 0.065 - 0.02);
  EXPECT_LT(run.quantity("tips.main_last.length"), 0.065 - 0.01 + 1e-12);
}

/// The scene of section 5.2 of the paper with a second fracture in the way of its right wing. What has just parted
/// conducts before it opens.
SceneRun wings(const std::string& wall) {
  return SceneRun("paper/wing_cracks.yaml",
                  with_values_of_paper({{"geometry.fractures.wall", wall},
                                        {"components.conduit.law", "{type: cubic, residual: 20 um}"},
                                        {"schedule.1.update", "after_step"}}));
}

TEST(Joining, FluidIsConservedAndFillsTheOtherFracture) {
  SceneRun run = wings("{points: [[1.1 m, 0.98 m], [1.12 m, 1.1 m]]}");
  double highest = 0, lowest = 6.9 * mega;  // of the fluid in fractures; the second one dilates as it slips
  int steps_after = 0;
  while (steps_after < 4) {
    ASSERT_TRUE(run.step());
    const double injected = run.quantity("fluid_injected");
    EXPECT_NEAR(run.quantity("fluid_balance_error"), 0, 1e-9 * injected);
    const Vector &rock = run.field("pore.pressure"), &fluid = run.field("conduit.pressure");
    highest = std::max(highest, fluid.maxCoeff());
    if (run.mesh().junctions.empty()) {
      lowest = std::min({lowest, fluid.minCoeff(), rock.minCoeff()});
      continue;
    }
    const double margin = 0.01 * (highest - 6.9 * mega);
    EXPECT_LT(rock.maxCoeff(), highest + margin) << run.time();
    EXPECT_GT(rock.minCoeff(), lowest - margin) << run.time();
    EXPECT_GT(fluid.minCoeff(), lowest - margin) << run.time();
    ++steps_after;
  }
  // Fractures conduct ten orders of magnitude better than the rock: one pressure in all.
  const Vector& fluid = run.field("conduit.pressure");
  EXPECT_LT(fluid.maxCoeff() - fluid.minCoeff(), 1e-4 * (highest - 6.9 * mega));
}

}  // namespace
}  // namespace sprekk::testing
