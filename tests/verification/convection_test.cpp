// Convection of a fluid that heat makes lighter: its onset, growth, heat transport, twins, and flow and heat in turn.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "tests/verification/buoyancy_scenes.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

constexpr double pi = std::numbers::pi;

/// The rate at which the first mode grows, 1/s, from the last of the steps, each of which multiplies an eigenmode by
/// 1/(1 − rate · step).
double growth(Square square, double dt = 0.2) {
  square.temperature = "1 - y + 1e-3*cos(pi*x)*sin(pi*y)";
  square.time = fmt::format("{{end: {} s, step: {} s}}", 4 * dt, dt);
  SceneRun run = SceneRun::from_text(square.text());
  double amplitude = 0, before = 0;
  run.run_until(4 * dt, [&] {
    before = amplitude;
    amplitude = 0;
    for (int c = 0; c < run.mesh().cell_count(); ++c) {
      const Point& x = run.mesh().cell_center[c];
      amplitude +=
          run.mesh().cell_measure[c] * run.field("heat.temperature")[c] * std::cos(pi * x[0]) * std::sin(pi * x[1]);
    }
  });
  return (1 - before / amplitude) / dt;
}

/// Horton and Rogers 1945, Lapwood 1948. In units of H, the conductivity k and the heat capacity c of the fluid, the
/// mode cos(pi x) sin(pi z) of the temperature moves fluid with w = Ra/2 of its size: 2 pi^2 w = Ra pi^2 T. It is fed
/// by w against the gradient −1, and decays by 2 pi^2: C dT/dt = (Ra/2 − 2 pi^2) T.
double growth_of_theory(double rayleigh, double heat_capacity) {
  return 2 * pi * pi * (rayleigh / (4 * pi * pi) - 1) / heat_capacity;
}

/// Where growth is zero, from two values around it, between which it is linear.
double critical(Square square) {
  square.gravity = {0, -39};
  const double below = growth(square);
  square.gravity = {0, -40};
  const double above = growth(square);
  return 39 + below / (below - above);
}

/// Reference: the critical Rayleigh number of a layer, 4 pi^2, and the growth of its first mode.
TEST(Buoyancy, ConvectionBeginsAtTheRayleighNumberOfALayer) {
  const double theory = 4 * pi * pi;
  const std::vector<std::pair<std::string, std::vector<int>>> all = {{"matrix_flow/mpfa", {8, 16, 32}},
                                                                     {"matrix_flow/rt0", {8, 16}},
                                                                     {"matrix_flow/tpfa", {16}},
                                                                     {"matrix_flow/ntpfa", {16}}};
  for (const auto& [flow, meshes] : all) {
    Square square;
    square.flow = flow;
    std::vector<double> errors;
    for (const int cells : meshes) {
      square.mesh = squares(cells);
      errors.push_back(critical(square) / theory - 1);
      std::printf("%s, %d cells: critical Ra off by %.3f %%\n", flow.c_str(), cells, 100 * errors.back());
      if (errors.size() > 1) {
        EXPECT_NEAR(std::log2(errors[errors.size() - 2] / errors.back()), 2, 0.15);
      }
    }
    EXPECT_LT(std::abs(errors.back()), 0.01);
  }
  // On triangles in no order.
  for (const std::string flow : {"matrix_flow/mpfa", "matrix_flow/rt0"}) {
    Square square;
    square.flow = flow;
    square.mesh = "{size: 0.1 m}";
    const double error = critical(square) / theory - 1;
    std::printf("%s, triangles of 0.1: critical Ra off by %.3f %%\n", flow.c_str(), 100 * error);
    EXPECT_LT(std::abs(error), 0.01);
  }
}

/// Reference: the same, with rock that stores 2.5 times the heat of the fluid in its place.
TEST(Buoyancy, ModesGrowAsInLinearTheory) {
  for (const double rayleigh : {30.0, 60.0}) {
    std::vector<double> errors;
    for (const int cells : {12, 24}) {
      Square square;
      square.mesh = squares(cells);
      square.heat_capacity = 2.5;
      square.gravity = {0, -rayleigh};
      errors.push_back(growth(square, 0.02) - growth_of_theory(rayleigh, 2.5));
      std::printf("Ra = %g, %d cells: growth %.4f off by %.4f\n", rayleigh, cells, growth_of_theory(rayleigh, 2.5),
                  errors.back());
    }
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.15);
    EXPECT_LT(std::abs(errors[1]), 0.015 * 2 * pi * pi / 2.5);
  }
}

/// What is conducted through the hot side of a square that is heated from the side or from below, 1 without convection.
double nusselt(Square square, int cells, const std::string& side) {
  square.mesh = squares(cells);
  square.time = "{end: 2.5 s, step: 0.25 s}";
  SceneRun run = SceneRun::from_text(square.text());
  run.run();
  double sum = 0;
  const Mesh& mesh = run.mesh();
  for (int f = 0; f < mesh.face_count(); ++f)
    if (mesh.face_side[f] != none && mesh.side_names[mesh.face_side[f]] == side)
      sum += 2 * (1 - run.field("heat.temperature")[mesh.face_cells[f][0]]);
  return sum;
}

/// Reference: tests/verification/references/porous_convection.py, which agrees with published values. Upwinding adds
/// |v| h/2 to the diffusivity, and the layers at the sides have errors of h^2: extrapolation from three meshes removes
/// both.
TEST(Buoyancy, HeatOfASquareIsThatOfTheReference) {
  for (const std::vector<double>& row :
       read_numbers(SPREKK_SOURCE_DIR "/tests/verification/references/porous_convection.csv")) {
    const bool from_side = row[0] == 1;
    if (row[1] > 100 || (!from_side && row[1] < 100)) continue;
    Square square;
    square.gravity = {0, -row[1]};
    if (from_side) {
      square.hot = "left";
      square.cold = "right";
      square.temperature = "1 - x";
    } else {
      square.temperature = "1 - y + 0.3*cos(pi*x)*sin(pi*y)";
    }
    std::vector<double> found;
    for (const int cells : {12, 24, 48}) found.push_back(nusselt(square, cells, square.hot));
    const double extrapolated = (8 * found[2] - 6 * found[1] + found[0]) / 3;
    std::printf(
        "%s, Ra = %g: Nu = %.4f, 12 cells %+.2f %%, 24 cells %+.2f %%, 48 cells %+.2f %%, extrapolated %+.2f %%\n",
        from_side ? "from the side" : "from below", row[1], row[2], 100 * (found[0] / row[2] - 1),
        100 * (found[1] / row[2] - 1), 100 * (found[2] / row[2] - 1), 100 * (extrapolated / row[2] - 1));
    EXPECT_LT(std::abs(extrapolated / row[2] - 1), 0.003);
    EXPECT_LT(std::abs(found[2] / row[2] - 1), 0.01);
  }
}

/// Temperature and pressure of a square that is heated from the side, in the order of places as without the map.
Vector heated(Square square, const std::array<double, 4>& map) {
  SceneRun run = SceneRun::from_text(square.text());
  run.run();
  std::map<std::pair<long, long>, std::pair<double, double>> values;
  const double lowest = run.field("pore.pressure").minCoeff();
  for (int c = 0; c < run.mesh().cell_count(); ++c) {
    const Point x = run.mesh().cell_center[c] - Point(0.5, 0.5);
    values[{std::lround(1e4 * (map[0] * x[0] + map[2] * x[1])), std::lround(1e4 * (map[1] * x[0] + map[3] * x[1]))}] = {
        run.field("heat.temperature")[c], run.field("pore.pressure")[c] - lowest};
  }
  Vector all(2 * values.size());
  int k = 0;
  for (const auto& [place, value] : values) {
    all[k++] = value.first;
    all[k++] = value.second / 1e4;
  }
  return all;
}

Square from_side() {
  Square square;
  square.gravity = {0, -80};
  square.hot = "left";
  square.cold = "right";
  square.temperature = "1 - x";
  square.mesh = squares(12);
  square.time = "{end: 0.1 s, step: 0.02 s}";
  return square;
}

/// Reference: symmetry, and that small changes of the data change the answer by little.
TEST(Buoyancy, TwinsConvectAlike) {
  const std::array<double, 4> same = {1, 0, 0, 1};
  const Vector here = heated(from_side(), same);
  Square turned = from_side();  // x to y, y to −x
  turned.gravity = {80, 0};
  turned.hot = "bottom";
  turned.cold = "top";
  turned.temperature = "1 - y";
  EXPECT_LT((heated(turned, {0, -1, 1, 0}) - here).lpNorm<Eigen::Infinity>(), 1e-8);
  Square mirrored = from_side();
  mirrored.hot = "right";
  mirrored.cold = "left";
  mirrored.temperature = "x";
  EXPECT_LT((heated(mirrored, {-1, 0, 0, 1}) - here).lpNorm<Eigen::Infinity>(), 1e-8);
  Square disturbed = from_side();
  disturbed.gravity *= 1 + 1e-9;
  EXPECT_LT((heated(disturbed, same) - here).lpNorm<Eigen::Infinity>(), 1e-7);
  EXPECT_GT((here - heated(
                        [] {
                          Square still = from_side();
                          still.gravity = {0, -1e-3};
                          return still;
                        }(),
                        same))
                .lpNorm<Eigen::Infinity>(),
            0.05);
}

/// Reference: the monolithic answer, to which flow and heat in turn converge.
TEST(Buoyancy, InTurnConvergesToMonolithic) {
  const std::array<double, 4> same = {1, 0, 0, 1};
  const Vector together = heated(from_side(), same);
  Square in_turn = from_side();
  in_turn.schedule =
      "[{iterate: {fallback: none, steps: [{solve: pore}, {solve: heat}], until: {relative: 1e-11, at_most: 100}}}]";
  EXPECT_LT((heated(in_turn, same) - together).lpNorm<Eigen::Infinity>(), 1e-7);
  in_turn.schedule =
      "[{iterate: {fallback: none, steps: [{solve: heat}, {solve: pore}], until: {relative: 1e-11, at_most: 100}}}]";
  EXPECT_LT((heated(in_turn, same) - together).lpNorm<Eigen::Infinity>(), 1e-7);
}

/// Reference: the factor 1/(1 − rate · step) of a mode, which is between −1 and 0 for steps above 2/rate.
TEST(Buoyancy, LongStepsThatHoldHeavyFluidUpAreNoted) {
  const auto is_noted = [](Square square, double dt) {
    square.mesh = squares(8);
    square.time = fmt::format("{{end: {} s, step: {} s}}", 2 * dt, dt);
    SceneRun run = SceneRun::from_text(square.text());
    bool found = false;
    run.run_until(2 * dt, [&] {
      Notes notes;
      for (const Part* part : run.model().parts()) part->note_step(notes, {run.time() - dt, dt, run.time()});
      for (const Notes::Note& note : notes.all())
        found = found || note.text.find("lies above lighter one") != std::string::npos;
    });
    return found;
  };
  Square heated_below;
  heated_below.gravity = {0, -200};
  heated_below.temperature = "1 - y + 1e-5*cos(pi*x)*sin(pi*y)";
  EXPECT_TRUE(is_noted(heated_below, 0.1));
  EXPECT_FALSE(is_noted(heated_below, 0.004));
  Square stable = heated_below;
  stable.gravity = {0, 200};
  EXPECT_FALSE(is_noted(stable, 0.1));
  Square moving = from_side();
  EXPECT_FALSE(is_noted(moving, 0.1));
}

}  // namespace
}  // namespace sprekk::testing
