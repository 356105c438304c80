// Two flows in the same rock, between which fluid passes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "framework/config/input_error.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

// Cracks that conduct, and blocks that store.
constexpr double crack_mobility = 1, block_mobility = 0.02, crack_storage = 0.1, block_storage = 2, exchange = 3;
constexpr double dt = 0.02;

std::string scene(const std::string& geometry, const std::string& mesh, const std::string& crack,
                  const std::string& block, const std::string& boundary,
                  const std::string& schedule = "{solve: [cracks, blocks]}") {
  return fmt::format(R"(
geometry: {}
mesh: {}
materials: {{viscosity: 1 Pa*s}}
components:
  cracks: {{type: matrix_flow/mpfa, permeability: 1 m^2, storage: 0.1 1/Pa, initial_pressure: {}, boundary: {}}}
  blocks: {{type: matrix_flow/tpfa, permeability: 0.02 m^2, storage: 2 1/Pa, initial_pressure: {}, boundary: {}}}
couplers: [{{type: matrix_exchange, between: [cracks, blocks], exchange: 3 1/(Pa*s)}}]
schedule: [{}]
time: {{end: 0.2 s, step: 0.02 s}}
)",
                     geometry, mesh, crack, boundary, block, boundary, schedule);
}

/// The amplitudes of the pressures of cracks and blocks in a mode with the wave number squared `k2` after some steps of
/// backward Euler from (1, 2): (S + dt (M k2 + E)) a' = S a.
Eigen::Vector2d amplitudes(double k2, int steps) {
  Eigen::Matrix2d storage = Eigen::Vector2d(crack_storage, block_storage).asDiagonal(), flow;
  flow << crack_mobility * k2 + exchange, -exchange, -exchange, block_mobility * k2 + exchange;
  const Eigen::Matrix2d step = (storage + dt * flow).inverse() * storage;
  Eigen::Vector2d a(1, 2);
  for (int i = 0; i < steps; ++i) a = step * a;
  return a;
}

/// The largest error of the mode sin(pi s) with s = x or y, drained at both ends.
double error_of_mode(int cells, bool along_x) {
  const std::string mode = along_x ? "sin(pi*x)" : "sin(pi*y)";
  SceneRun run = SceneRun::from_text(
      scene(along_x ? "{box: {x: [0 m, 1 m], y: [0 m, 0.1 m]}}" : "{box: {x: [0 m, 0.1 m], y: [0 m, 1 m]}}",
            fmt::format("{{kind: structured, cells: [{}, {}], shape: quadrilaterals}}", along_x ? cells : 2,
                        along_x ? 2 : cells),
            "(" + mode + ") Pa", "(2*" + mode + ") Pa",
            along_x ? "{left: {pressure: 0 Pa}, right: {pressure: 0 Pa}}"
                    : "{bottom: {pressure: 0 Pa}, top: {pressure: 0 Pa}}"));
  double worst = 0;
  for (int step = 1; step <= 10; ++step) {
    EXPECT_TRUE(run.step());
    const Eigen::Vector2d exact = amplitudes(std::numbers::pi * std::numbers::pi, step);
    for (int c = 0; c < run.mesh().cell_count(); ++c) {
      const double s = std::sin(std::numbers::pi * run.mesh().cell_center[c][along_x ? 0 : 1]);
      worst = std::max({worst, std::abs(run.field("cracks.pressure")[c] - exact[0] * s),
                        std::abs(run.field("blocks.pressure")[c] - exact[1] * s)});
    }
  }
  return worst;
}

TEST(DoublePorosity, ModesDecayAsInTheClosedForm) {
  for (const bool along_x : {true, false}) {
    const double coarse = error_of_mode(20, along_x), fine = error_of_mode(40, along_x);
    std::printf("errors %.2e, %.2e, order %.2f\n", coarse, fine, std::log2(coarse / fine));
    EXPECT_GT(std::log2(coarse / fine), 1.9);
    EXPECT_LT(fine, 1e-3);
  }
}

/// Reference: without outflow the mode of the wave number 0, on any cells, to round-off; nothing is lost.
TEST(DoublePorosity, PressuresInAClosedBoxComeTogether) {
  SceneRun run =
      SceneRun::from_text(scene("{box: {x: [0 m, 1 m], y: [0 m, 0.7 m]}}", "{size: 0.2 m}", "1 Pa", "2 Pa", "{}"));
  for (int step = 1; step <= 10; ++step) {
    ASSERT_TRUE(run.step());
    const Eigen::Vector2d exact = amplitudes(0, step);
    for (int c = 0; c < run.mesh().cell_count(); ++c) {
      EXPECT_NEAR(run.field("cracks.pressure")[c], exact[0], 1e-12);
      EXPECT_NEAR(run.field("blocks.pressure")[c], exact[1], 1e-12);
    }
  }
  EXPECT_LT(std::abs(run.quantity("fluid_balance_error")), 1e-13);
}

TEST(DoublePorosity, FlowsInTwoSolvesAndOtherMistakesAreRefused) {
  const std::string box = "{box: {x: [0 m, 1 m], y: [0 m, 0.7 m]}}", mesh = "{size: 0.2 m}";
  EXPECT_THROW(SceneRun::from_text(scene(box, mesh, "1 Pa", "2 Pa", "{}", "{solve: cracks}, {solve: blocks}")),
               InputError);
  std::string text = scene(box, mesh, "1 Pa", "2 Pa", "{}");
  text.replace(text.find("[cracks, blocks], exchange"), 16, "[cracks]");
  EXPECT_THROW(SceneRun::from_text(text), InputError);
}

}  // namespace
}  // namespace sprekk::testing
