// Flow in the matrix whose properties change with time.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "framework/assembly/counts_work.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

constexpr double hour = 3600, length = 10;
constexpr int cells = 20;

struct Properties {
  std::string permeability = "1e-16 m^2", viscosity = "1 mPa*s", storage = "1e-10 1/Pa";
};

/// One mode of the pressure in a closed column: with k/(mu S) = 1e-3 m^2/s it falls by 1/e in 2.8 h.
std::string mode(const Properties& properties, double step, const std::string& more = "") {
  return fmt::format(
      "{{geometry: {{box: {{x: [0 m, 10 m], y: [0 m, 1 m]}}}}, mesh: {{kind: structured, shape: quadrilaterals, cells: "
      "[{}, 2]}}, components: {{pore: {{type: matrix_flow/mpfa, permeability: {}, viscosity: {}, storage: {}, "
      "initial_pressure: \"(cos(pi*x/10)) MPa\"}}}}, schedule: [{{solve: pore}}], time: {{end: 4 h, step: {} s}}{}}}",
      cells, properties.permeability, properties.viscosity, properties.storage, step, more);
}

double amplitude(const SceneRun& run) {
  return run.field("pore.pressure")[0] / std::cos(std::numbers::pi * run.mesh().cell_center[0][0] / length);
}

long count(SceneRun& run, const std::string& name) {
  return parts_with<CountsWork>(run.model().parts()).front()->counts().at(name);
}

/// On equal cells a cosine is an eigenvector of the fluxes, with this eigenvalue in place of (pi/L)^2.
double eigenvalue() {
  const double h = length / cells;
  return 2 * (1 - std::cos(std::numbers::pi * h / length)) / (h * h);
}

/// Backward Euler multiplies the mode by 1/(1 + dt k lambda/(mu S)), with properties of the end of the step.
TEST(FlowInTime, ModeDecaysByTheFactorsOfTheStepsEnds) {
  for (const Properties& properties :
       {Properties{"\"(1e-16*(1 + t/7200)) m^2\""}, Properties{.viscosity = "\"(1e-3/(1 + t/7200)) Pa*s\""},
        Properties{.storage = "\"(1e-10/(1 + t/7200)) 1/Pa\""}}) {
    SceneRun run = SceneRun::from_text(mode(properties, 1800));
    double expected = 1e6;
    run.run_until(4 * hour, [&] {
      expected /= 1 + 1800 * 1e-3 * (1 + run.time() / 7200) * eigenvalue();
      EXPECT_NEAR(amplitude(run), expected, 1e-10 * 1e6) << run.time();
    });
    // A storage that changes makes no other fluxes.
    EXPECT_EQ(count(run, "flux discretizations"), properties.storage == Properties{}.storage ? 8 : 1);
  }
}

/// The heat equation in the time tau = int k dt: p = exp(-lambda tau/(mu S)).
TEST(FlowInTime, IsOfFirstOrderInTheStep) {
  const double tau = 4 * hour + 16 * hour * hour / (2 * 7200);
  const double exact = 1e6 * std::exp(-1e-3 * eigenvalue() * tau);
  double last = 0;
  for (const double step : {900.0, 450.0, 225.0}) {
    SceneRun run = SceneRun::from_text(mode({"\"(1e-16*(1 + t/7200)) m^2\""}, step));
    run.run();
    const double error = std::abs(amplitude(run) - exact);
    if (last > 0) {
      EXPECT_NEAR(std::log2(last / error), 1, 0.1);
    }
    last = error;
  }
}

/// One jump costs one discretization and one factorization, and steps end at it.
TEST(FlowInTime, JumpCostsOneDiscretization) {
  SceneRun constant = SceneRun::from_text(mode({}, 1800));
  SceneRun jumps = SceneRun::from_text(mode({"[{value: 1e-16 m^2}, {value: 1e-16 m^2, from: 2 h}]"}, 1800));
  constant.run();
  double expected = 1e6;
  jumps.run_until(4 * hour, [&] {
    expected /= 1 + 1800 * (jumps.time() > 2 * hour ? 2e-3 : 1e-3) * eigenvalue();
    EXPECT_NEAR(amplitude(jumps), expected, 1e-10 * 1e6) << jumps.time();
  });
  EXPECT_EQ(count(constant, "flux discretizations"), 1);
  EXPECT_EQ(count(jumps, "flux discretizations"), 2);
  EXPECT_EQ(constant.linear_counts().factorizations, 1);
  EXPECT_EQ(jumps.linear_counts().factorizations, 2);

  SceneRun between = SceneRun::from_text(mode({"[{value: 1e-16 m^2}, {value: 1e-16 m^2, from: 45 min}]"}, 1800));
  std::vector<double> ends;
  between.run_until(1.25 * hour, [&] { ends.push_back(between.time()); });
  EXPECT_EQ(ends, (std::vector<double>{1800, 2700, 4500}));
}

/// The value before the jump is not evaluated again while it holds: the answer has the bits of a constant one.
TEST(FlowInTime, PropertyThatDoesNotChangeYetIsConstant) {
  SceneRun constant = SceneRun::from_text(mode({}, 1800));
  SceneRun later = SceneRun::from_text(mode({"[{value: 1e-16 m^2}, {value: 1e-16 m^2, from: 5 h}]"}, 1800));
  constant.run();
  later.run();
  EXPECT_EQ(constant.field("pore.pressure"), later.field("pore.pressure"));
  EXPECT_EQ(count(later, "flux discretizations"), 1);
  EXPECT_EQ(later.linear_counts().factorizations, 1);
}

/// A storage that changes moves no fluid.
TEST(FlowInTime, RestStaysRestWhenStorageChanges) {
  std::string scene = mode({.storage = "\"(1e-10*(1 + t/7200)) 1/Pa\""}, 1800);
  const std::string initial = "\"(cos(pi*x/10)) MPa\"";
  scene.replace(scene.find(initial), initial.size(), "3 MPa");
  SceneRun run = SceneRun::from_text(scene);
  run.run();
  EXPECT_EQ(run.field("pore.pressure"), Vector::Constant(2 * cells, 3e6));
}

/// Rock that opens: no flux at all before, and the mode decays from then on.
TEST(FlowInTime, RockThatLetsNothingThroughMayOpen) {
  SceneRun run = SceneRun::from_text(mode({"{value: 1e-16 m^2, from: 2 h}"}, 1800));
  double expected = 1e6;
  run.run_until(4 * hour, [&] {
    if (run.time() > 2 * hour) expected /= 1 + 1800 * 1e-3 * eigenvalue();
    EXPECT_NEAR(amplitude(run), expected, 1e-10 * 1e6) << run.time();
  });
}

}  // namespace
}  // namespace sprekk::testing
