// Wells with limits: which limit binds, balances, derivatives, and what is refused.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "components/wells/limited_wells.hpp"
#include "framework/config/input_error.hpp"
#include "tests/verification/balance_error.hpp"
#include "tests/verification/derivatives.hpp"

namespace sprekk::testing {
namespace {

/// A closed box of one pressure, since its rock hardly resists, with the storage 1e-7 m^2/Pa. A well of the index
/// 1e-11 m^2/(Pa s) fills it, or with the sign −1 empties it.
std::string closed_box(double sign, const std::string& limit, double step, const std::string& more = "") {
  return fmt::format(R"(
geometry: {{box: {{x: [0 m, 10 m], y: [0 m, 10 m]}}}}
mesh: {{kind: structured, cells: [5, 5], shape: quadrilaterals}}
components:
  pore: {{type: matrix_flow/tpfa, permeability: 1e-8 m^2, viscosity: 1 mPa*s, storage: 1e-9 1/Pa, initial_pressure: 1 MPa}}
  wells:
    type: wells/limited
    wells:
      w: {{at: [5 m, 5 m], index: 1e-11 m^2/(Pa*s), rate: {} m^2/s, {}}}
{}
couplers: [{{type: well_exchange, between: [wells, pore]}}]
schedule: [{{solve: [pore, wells]}}]
time: {{end: 3e4 s, step: {} s}}
)",
                     sign * 1e-6, limit, more, step);
}

/// Reference: the closed form. The pressure of the well is p + R Q, and p rises by Q/C a second until the well reaches
/// its limit P at t* = (P − p_0 − R Q) C/Q; from there on p approaches P with the time R C.
TEST(Wells, LimitBindsAtItsTime) {
  const double capacity = 1e-7, resistance = 1e11, rate = 1e-6, gap = 203e3;
  const double switched = (gap - resistance * rate) * capacity / rate;
  for (const double sign : {1.0, -1.0}) {
    double coarser = 0;
    for (const double dt : {500.0, 250.0, 125.0}) {
      SceneRun run = SceneRun::from_text(
          closed_box(sign, sign > 0 ? "highest_pressure: 1.203 MPa" : "lowest_pressure: 0.797 MPa", dt));
      double error = 0, implicit = 0;
      run.run_until(3e4, [&] {
        const double q = sign * run.quantity("wells.w.rate"), p = sign * (run.quantity("wells.w.pressure") - 1e6);
        const double binds = run.quantity("wells.w.binds_0_rate_1_pressure_2_shut");
        EXPECT_LE(run.iterations(), 3);
        // Backward Euler: the larger of both is wrong by nothing before, and follows its own formula after.
        const double free = implicit + rate * dt / capacity;
        const bool is_bound = free + resistance * rate > gap;
        implicit =
            is_bound ? (implicit + dt / (resistance * capacity) * gap) / (1 + dt / (resistance * capacity)) : free;
        EXPECT_EQ(binds, is_bound ? 1 : 0) << run.time();
        EXPECT_NEAR(q / (is_bound ? (gap - implicit) / resistance : rate), 1, 1e-6);
        EXPECT_NEAR(p / (is_bound ? gap : implicit + resistance * rate), 1, 1e-6);
        EXPECT_EQ(is_bound, run.time() > switched + 1e-6) << run.time();
        if (is_bound) {
          const double exact = rate * std::exp(-(run.time() - switched) / (resistance * capacity));
          error = std::max(error, std::abs(q - exact) / rate);
        }
      });
      std::printf("steps of %.0f s: error of the rate %.2e, order %.2f\n", dt, error, std::log2(coarser / error));
      EXPECT_LT(error, dt / (resistance * capacity));
      if (coarser > 0) {
        EXPECT_GT(std::log2(coarser / error), 0.8);
      }
      coarser = error;
      EXPECT_LT(balance_error(run), 1e-9);
    }
  }
}

/// Another well raises the pressure of the box above the limit: the first one shuts, and does not flow back.
TEST(Wells, ShutsWhereThePressureIsBeyondItsLimit) {
  SceneRun run =
      SceneRun::from_text(closed_box(1, "highest_pressure: 1.203 MPa", 250,
                                     "      other: {at: [1 m, 1 m], index: 1e-11 m^2/(Pa*s), rate: 2e-5 m^2/s}\n"));
  std::vector<double> states;
  run.run_until(3e4, [&] {
    const double state = run.quantity("wells.w.binds_0_rate_1_pressure_2_shut");
    if (states.empty() || states.back() != state) states.push_back(state);
    EXPECT_GE(run.quantity("wells.w.rate"), -1e-18);
  });
  EXPECT_EQ(states, (std::vector<double>{0, 1, 2}));
  EXPECT_GT(run.quantity("wells.w.pressure"), 1.203e6);
  EXPECT_LT(balance_error(run), 1e-9);
}

/// The branches of a well, with the sign of the rate.
TEST(Wells, BranchIsWhatTheConditionsSay) {
  using wells::Binding;
  using wells::binding;
  for (const double sign : {1.0, -1.0}) {
    const wells::Control control{.rate = sign * 2, .has_limit = true, .pressure = sign * 10};
    for (const double resistance : {0.1, 1.0, 30.0}) {
      EXPECT_EQ(binding(control, sign * 5, sign * 2, resistance), Binding::rate);
      EXPECT_EQ(binding(control, sign * 10, sign * 1, resistance), Binding::pressure);
      EXPECT_EQ(binding(control, sign * 15, 0, resistance), Binding::shut);
    }
  }
  EXPECT_EQ(binding({.rate = 2}, 1e9, 0, 1), Binding::rate);
  EXPECT_EQ(binding({.rate = 0, .has_limit = true}, 1e9, 1, 1), Binding::rate);
  EXPECT_EQ(binding({.has_pressure = true, .pressure = 3}, 1e9, 7, 1), Binding::pressure);
}

/// All derivatives of wells and of what they feed, against differences.
TEST(Wells, Derivatives) {
  SceneRun run = SceneRun::from_text(R"(
geometry:
  box: {x: [-1, 1], y: [-1, 1]}
  fractures: {a: {points: [[-1, 0.1], [0.7, 0]]}}
mesh: {size: 0.6, fracture_size: 0.4}
materials: {viscosity: 1 Pa*s, permeability: 1 m^2}
components:
  pore: {type: matrix_flow/mpfa, storage: 0.7 1/Pa}
  conduit: {type: fracture_flow/tpfa, fluid_compressibility: 0.1 1/Pa, initial_aperture: 1 m}
  wells:
    type: wells/limited
    wells:
      both: {rate: 3 m^2/s, highest_pressure: 1 Pa, places: {rock: {at: [0.5, 0.5], index: 2 m^2/(Pa*s)}, fracture: {at: [0.3, 0.02], fracture: a}}}
      held: {pressure: 1 Pa, at: [-0.5, 0.6], index: 3 m^2/(Pa*s)}
couplers:
  - {type: wall_exchange, between: [pore, conduit]}
  - {type: well_exchange, between: [wells, pore, conduit]}
schedule: [{solve: [pore, conduit, wells]}]
time: {end: 1 s, step: 1 s}
)");
  const std::string pressure = "wells.pressure", rate = "wells.rate", rock = "pore.pressure",
                    water = "conduit.pressure";
  expect_derivatives(
      run, {{pressure, 2, 3}, {rate, 0.5, 1}, {rock, -1, 1}, {water, -1, 1}}, 4,
      {{pressure, pressure}, {rate, pressure}, {rate, rate}, {rate, rock}, {rate, water}, {rock, rate}, {water, rate}});
}

/// What a scene may not ask for, and the words of the answer, when it is built.
TEST(Wells, MistakesAreRefused) {
  const auto has = [](const std::string& from, const std::string& to, const std::string& words) {
    std::string scene = closed_box(1, "highest_pressure: 1.203 MPa", 500), said;
    const auto place = scene.find(from);
    ASSERT_NE(place, std::string::npos) << from;
    scene.replace(place, from.size(), to);
    try {
      SceneRun run = SceneRun::from_text(scene);
    } catch (const InputError& error) {
      said = error.what();
    }
    EXPECT_NE(said.find(words), std::string::npos) << said;
  };
  const std::string index = "index: 1e-11 m^2/(Pa*s)", limit = "highest_pressure: 1.203 MPa";
  has("at: [5 m, 5 m]", "at: [5 m, 15 m]", "lies outside the rock");
  has(limit, "highest_pressure: 0.9 MPa", "on the wrong side");
  has(limit, "lowest_pressure: 0.9 MPa", "never binds");
  has(limit, limit + ", lowest_pressure: 2 MPa", "contradict one another");
  has(limit, limit + ", pressure: 2 MPa", "contradicts the rate");
  has(index, "index: -1e-11 m^2/(Pa*s)", "index");
  has(index, "radius: 3 m", "is not positive");
  has("at: [5 m, 5 m], " + index, "at: [0.5 m, 5 m]", "touches a side");
  has(index, index + ", radius: 0.1 m", "have no effect");
  has(index, "fracture: f", "fracture without fluid");
  has("[{solve: [pore, wells]}]", "[{solve: pore}, {solve: wells}]", "is solved without");
  has("[{type: well_exchange, between: [wells, pore]}]", "[]", "needs a coupler of type 'well_exchange'");
  std::string rt0 = closed_box(1, limit, 500);
  rt0.replace(rt0.find("matrix_flow/tpfa"), 16, "matrix_flow/rt0");
  rt0.replace(rt0.find(index), index.size(), "radius: 0.1 m");
  EXPECT_THROW(SceneRun::from_text(rt0), InputError);
}

}  // namespace
}  // namespace sprekk::testing
