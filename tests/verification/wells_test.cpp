// Wells with limits: their index, which limit binds, balances, and what must not matter.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "components/capabilities/fluid_fluxes.hpp"
#include "components/wells/limited_wells.hpp"
#include "couplers/well_exchange/early_resistance.hpp"
#include "couplers/well_exchange/equivalent_radius.hpp"
#include "framework/config/input_error.hpp"
#include "framework/mesh/point_location.hpp"
#include "tests/verification/derivatives.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

/// |stored + outflow − injected| over the throughput.
double balance_error(SceneRun& run) {
  std::map<std::string, Balance> balances;
  for (const Part* part : run.model().parts()) part->balance(balances);
  const Balance& fluid = balances.at("fluid");
  EXPECT_GT(fluid.throughput, 0);
  return std::abs(fluid.stored + fluid.outflow - fluid.injected) / fluid.throughput;
}

const MatrixFluxes& fluxes_of(SceneRun& run) {
  for (const Part* part : run.model().parts())
    if (const auto* fluxes = dynamic_cast<const MatrixFluxes*>(part)) return *fluxes;
  throw std::logic_error("no flow");
}

/// Reference: Peaceman 1983, e^-gamma/4 sqrt(sqrt(k_y/k_x) h_x^2 + sqrt(k_x/k_y) h_y^2), for the two-point flux on
/// rectangles without end, with a source in one cell. The patch of eight layers gives it to 1.5e-3.
TEST(Wells, EquivalentRadiusIsPeacemans) {
  for (const auto& [hx, hy, kx, ky] :
       {std::array{20.0, 20.0, 1.0, 1.0}, {20.0, 10.0, 1.0, 1.0}, {20.0, 20.0, 4.0, 1.0}, {15.0, 20.0, 1.0, 3.0}}) {
    SceneRun run("verification/theis.yaml",
                 {{"geometry.box", fmt::format("{{x: [0 m, {} m], y: [0 m, {} m]}}", 51 * hx, 51 * hy)},
                  {"components.pore.type", "matrix_flow/tpfa"},
                  {"materials.permeability", fmt::format("{{xx: {}e-13 m^2, yy: {}e-13 m^2}}", kx, ky)},
                  {"components.wells.wells.feed.at", fmt::format("[{} m, {} m]", 25.5 * hx, 25.5 * hy)}});
    const Point at(25.5 * hx, 25.5 * hy);
    const Tensor mobility = Point(kx, ky).asDiagonal();
    const double found =
        *couplers::equivalent_radius(run.mesh(), fluxes_of(run), PointLocation(run.mesh()).cell_at(at), mobility);
    const double exact =
        std::exp(-std::numbers::egamma) / 4 * std::sqrt(std::sqrt(ky / kx) * hx * hx + std::sqrt(kx / ky) * hy * hy);
    std::printf("r_e %.5f m, Peaceman %.5f m: %.1e\n", found, exact, found / exact - 1);
    EXPECT_NEAR(found / exact, 1, 2e-3);
  }
}

/// A mesh and a rock with a well; `at`: a point of the cell of the well.
struct TheisCase {
  std::string name, type, mesh, permeability;
  Point at;
  Tensor mobility;
};

Tensor tensor(double xx, double yy, double xy) { return (Tensor() << xx, xy, xy, yy).finished(); }

std::string theis(const TheisCase& of, double step, double end) {
  return fmt::format(R"(
geometry: {{box: {{x: [0 m, 1020 m], y: [0 m, 1020 m]}}}}
mesh: {}
components:
  pore: {{type: {}, permeability: {}, viscosity: 1 mPa*s, storage: 1e-9 1/Pa, initial_pressure: 20 MPa}}
  wells: {{type: wells/limited, wells: {{feed: {{at: [{} m, {} m], rate: 1e-4 m^2/s, radius: 0.1 m}}}}}}
couplers: [{{type: well_exchange, between: [wells, pore]}}]
schedule: [{{solve: [pore, wells]}}]
time: {{end: {} s, step: {} s}}
)",
                     of.mesh, of.type, of.permeability, of.at[0], of.at[1], end, step);
}

/// The meshes and rocks in which a well is compared with Theis.
std::vector<TheisCase> theis_cases() {
  const std::string squares = "{kind: structured, cells: [51, 51], shape: quadrilaterals}";
  const std::string triangles = "{kind: structured, cells: [51, 51], shape: triangles}";
  const std::string isotropic = "1e-13 m^2", along = "{xx: 4e-13 m^2, yy: 1e-13 m^2}";
  const std::string oblique = "{along: 4e-13 m^2, across: 1e-13 m^2, angle: 30 deg}";
  const Tensor one = tensor(1e-10, 1e-10, 0), four = tensor(4e-10, 1e-10, 0);
  const double c = std::cos(std::numbers::pi / 6), s = 0.5;
  const Tensor turned = tensor(4e-10 * c * c + 1e-10 * s * s, 4e-10 * s * s + 1e-10 * c * c, 3e-10 * c * s);
  return {{"squares, two points", "matrix_flow/tpfa", squares, isotropic, {510, 510}, one},
          {"squares, multi-point", "matrix_flow/mpfa", squares, isotropic, {516, 503}, one},
          {"triangles", "matrix_flow/mpfa", triangles, isotropic, {513, 507}, one},
          {"unstructured", "matrix_flow/mpfa", "{size: 22 m}", isotropic, {508, 511}, one},
          {"anisotropic, two points", "matrix_flow/tpfa", squares, along, {510, 510}, four},
          {"anisotropic, oblique", "matrix_flow/mpfa", squares, oblique, {510, 510}, turned},
          {"anisotropic, triangles", "matrix_flow/mpfa", "{size: 22 m}", oblique, {508, 511}, turned}};
}

/// The rise of the pressure (Pa) at the time t after a well of 1e-4 m^2/s has begun.
double theis_pressure(const Tensor& mobility, double t) {
  const double size = std::sqrt(mobility.determinant()), bore = couplers::radius_of_bore_hole(0.1, mobility);
  return 1e-4 / (4 * std::numbers::pi * size) * -std::expint(-bore * bore / (4 * size / 1e-9 * t));
}

/// Reference: Theis 1935, also in anisotropic rock, where the bore hole is a circle of radius_of_bore_hole. From 25
/// r_e^2/c on, Peaceman's bound for squares, where on triangles the flow has hardly left the cell of the well: with the
/// steady index alone the error was up to 6 % there. Then the well is shut, and its pressure falls: by superposition
/// as that of two wells (Horner).
TEST(Wells, PressureIsThatOfTheis) {
  for (const TheisCase& each : theis_cases()) {
    SceneRun trial = SceneRun::from_text(theis(each, 1, 1));
    const int home = PointLocation(trial.mesh()).cell_at(each.at);
    const double radius = *couplers::equivalent_radius(trial.mesh(), fluxes_of(trial), home, each.mobility);
    const double diffusivity = std::sqrt(each.mobility.determinant()) / 1e-9;
    const double first = 25 * radius * radius / diffusivity, filled = 4 * trial.mesh().cell_measure[home] / diffusivity;
    const double shut = 2 * filled, last = 3 * filled;
    ASSERT_LT(std::sqrt(4 * each.mobility.diagonal().maxCoeff() / 1e-9 * last), 510 / 2.0);  // the sides feel nothing
    std::string scene = theis(each, filled / 100, last);
    const std::string rate = "rate: 1e-4 m^2/s";
    scene.replace(scene.find(rate), rate.size(), fmt::format("rate: {{value: 1e-4 m^2/s, to: {} s}}", shut));
    SceneRun run = SceneRun::from_text(scene);
    double worst = 0, late = 0, after = 0;
    run.run_until(last, [&] {
      const double rise = run.quantity("wells.feed.pressure") - 20e6, t = run.time();
      const double whole = theis_pressure(each.mobility, t);
      if (t > shut * (1 + 1e-9)) {
        if (t >= shut + first)
          after = std::max(after, std::abs(rise - whole + theis_pressure(each.mobility, t - shut)) / whole);
        return;
      }
      const double error = std::abs(rise / whole - 1);
      if (t >= first) worst = std::max(worst, error);
      if (t >= filled) late = std::max(late, error);
    });
    std::printf("%s: r_e %.2f m, c t/A from %.2f on: worst %.2e, from 4 on %.2e, when shut %.2e\n", each.name.c_str(),
                radius, first * diffusivity / trial.mesh().cell_measure[home], worst, late, after);
    EXPECT_LT(worst, 0.01) << each.name;
    EXPECT_LT(late, 0.005) << each.name;
    EXPECT_LT(after, 0.01) << each.name;
    EXPECT_LT(balance_error(run), 1e-9) << each.name;
  }
}

/// The resistance is positive over each time, and from some c t on it is the steady one: otherwise a well that holds a
/// pressure would be unstable.
TEST(Wells, EarlyResistanceIsPositive) {
  for (const TheisCase& each : theis_cases()) {
    SceneRun trial = SceneRun::from_text(theis(each, 1, 1));
    const int home = PointLocation(trial.mesh()).cell_at(each.at);
    const double area = trial.mesh().cell_measure[home];
    for (const double bore : {1e-3, 1.0}) {
      const couplers::EarlyResistance early =
          *couplers::early_resistance(trial.mesh(), fluxes_of(trial), home, each.mobility, bore);
      double least = early.log_of_radii;
      for (double length = 1e-8 * bore * bore; length < 1e8 * area; length *= 1.5) {
        double resistance = early.log_of_radii;
        for (int k = 0; k < couplers::early_terms; ++k) resistance += early.weights[k] / (1 + length / early.scales[k]);
        least = std::min(least, resistance);
        if (length > 1e4 * area) {
          EXPECT_NEAR(resistance / early.log_of_radii, 1, 1e-3) << each.name;
        }
      }
      EXPECT_GT(least, 0) << each.name << ", bore hole of " << bore;
    }
  }
}

/// Reference: a well that crosses a fracture of finite conductivity, which drains into rock on both sides. As long as
/// the flow in both is linear (bilinear flow, Cinco-Ley and Samaniego 1981, after Bodvarsson), its pressure is
///   p = Q/(2 sqrt(2)) t^(1/4)/(Gamma(5/4) sqrt(T_f) (T S)^(1/4)),
/// with the transmissivity T_f of the fracture, and T = k/mu and S of the rock.
TEST(Wells, ThatCrossesAFractureSeesBilinearFlow) {
  double coarser = 0;
  for (const int cells : {20, 40, 80}) {
    SceneRun run = SceneRun::from_text(fmt::format(R"(
geometry:
  box: {{x: [-200 m, 200 m], y: [-2.5 m, 2.5 m]}}
  fractures: {{f: {{points: [[-200 m, 0 m], [200 m, 0 m]]}}}}
mesh: {{kind: structured, cells: [{}, {}], shape: quadrilaterals}}
materials: {{viscosity: 1 mPa*s, fluid_compressibility: 4e-14 1/Pa}}
components:
  pore: {{type: matrix_flow/mpfa, permeability: 1e-16 m^2, storage: 1e-9 1/Pa, initial_pressure: 2 MPa}}
  conduit: {{type: fracture_flow/tpfa, initial_aperture: 0.2 mm, initial_pressure: 2 MPa}}
  wells: {{type: wells/limited, wells: {{w: {{at: [0 m, 0 m], fracture: f, rate: 1e-6 m^2/s}}}}}}
couplers:
  - {{type: wall_exchange, between: [pore, conduit]}}
  - {{type: well_exchange, between: [wells, pore, conduit]}}
schedule: [{{solve: [pore, conduit, wells]}}]
time: {{end: 4000 s, step: {} s}}
)",
                                                   cells + 1, cells, 4000.0 / cells));
    run.run();
    const double conductance = std::pow(2e-4, 3) / 12e-3;
    const double exact = 1e-6 / (2 * std::sqrt(2.0)) * std::pow(4000, 0.25) /
                         (std::tgamma(1.25) * std::sqrt(conductance) * std::pow(1e-13 * 1e-9, 0.25));
    const double error = std::abs((run.quantity("wells.w.pressure") - 2e6) / exact - 1);
    std::printf("%d cells: rise %.3e Pa, exact %.3e Pa, error %.2e, order %.2f\n", cells,
                run.quantity("wells.w.pressure") - 2e6, exact, error, std::log2(coarser / error));
    EXPECT_LT(error, 2.0 / cells);
    EXPECT_LT(balance_error(run), 1e-9);
    coarser = error;
  }
}

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

/// Reference: flow along a fracture without end with tight walls from a well in its middle, p = Q sqrt(t/(pi T s)),
/// T = a^3/(12 mu), s = a c_f.
TEST(Wells, InAFractureFeedsBothSidesOfIt) {
  double coarser = 0;
  for (const int cells : {101, 201, 401}) {
    const double dt = 0.04 * 101 / cells;
    SceneRun run = SceneRun::from_text(fmt::format(R"(
geometry:
  box: {{x: [-101 m, 101 m], y: [-2 m, 2 m]}}
  fractures: {{f: {{points: [[-101 m, 0 m], [101 m, 0 m]]}}}}
mesh: {{kind: structured, cells: [{}, 2], shape: quadrilaterals}}
materials: {{viscosity: 1 mPa*s, fluid_compressibility: 4e-10 1/Pa}}
components:
  conduit: {{type: fracture_flow/tpfa, initial_aperture: 0.02 mm, initial_pressure: 2 MPa}}
  wells: {{type: wells/limited, wells: {{w: {{at: [0 m, 0 m], fracture: f, rate: 1e-9 m^2/s}}}}}}
couplers: [{{type: well_exchange, between: [wells, conduit]}}]
schedule: [{{solve: [conduit, wells]}}]
time: {{end: 4 s, step: {} s}}
)",
                                                   cells, dt));
    run.run();
    const double transmissivity = std::pow(2e-5, 3) / 12e-3, storage = 2e-5 * 4e-10;
    const double exact = 1e-9 * std::sqrt(4 / (std::numbers::pi * transmissivity * storage));
    const double error = std::abs((run.quantity("wells.w.pressure") - 2e6) / exact - 1);
    std::printf("%d cells: error %.2e, order %.2f\n", cells, error, std::log2(coarser / error));
    EXPECT_LT(error, 0.02 * 101 / cells);
    EXPECT_LT(balance_error(run), 1e-9);
    coarser = error;
  }
}

/// A map of the plane by whole right angles and mirrors, and the side that it takes the left one to.
struct Twin {
  double xx, xy, yx, yy;
  std::string left;
  std::string operator()(double x, double y) const {
    return fmt::format("[{} m, {} m]", xx * x + xy * y, yx * x + yy * y);
  }
};
const Twin same{1, 0, 0, 1, "left"}, turned{0, -1, 1, 0, "bottom"}, mirrored{-1, 0, 0, 1, "right"};

/// A network of two fractures in rock with three wells: one in the rock, one in a fracture, and one that is open to
/// both fractures and the rock and reaches its limit.
std::string network(const Twin& at, const std::string& schedule = "[{solve: [pore, conduit, wells]}]",
                    double rate = 1e-5) {
  return fmt::format(R"(
geometry:
  box: {{x: [-20 m, 20 m], y: [-20 m, 20 m]}}
  fractures: {{a: {{points: [{}, {}]}}, b: {{points: [{}, {}]}}}}
mesh: {{kind: structured, cells: [40, 40], shape: quadrilaterals}}
materials: {{viscosity: 1 mPa*s, fluid_compressibility: 4e-10 1/Pa}}
components:
  pore:
    type: matrix_flow/tpfa
    permeability: 1e-14 m^2
    porosity: 0.1
    initial_pressure: 10 MPa
    boundary: {{{}: {{pressure: 10 MPa}}}}
  conduit: {{type: fracture_flow/tpfa, initial_aperture: 0.2 mm, initial_pressure: 10 MPa}}
  wells:
    type: wells/limited
    wells:
      feed: {{rate: {} m^2/s, highest_pressure: 10.125 MPa, places: {{one: {{at: {}, fracture: a}}, two: {{at: {}, fracture: b}}, rock: {{at: {}}}}}}}
      outlet: {{at: {}, rate: -5e-6 m^2/s, lowest_pressure: 9.5 MPa, radius: 0.05 m, skin: 1}}
      drain: {{at: {}, fracture: b, pressure: 10 MPa, index: 1e-10 m^2/(Pa*s)}}
couplers:
  - {{type: wall_exchange, between: [pore, conduit]}}
  - {{type: well_exchange, between: [wells, pore, conduit]}}
schedule: {}
time: {{end: 2 h, step: 10 min}}
)",
                     at(-15, 3), at(5, 3), at(8, -12), at(8, 14), at.left, rate, at(-10.5, 3), at(8, 10.5),
                     at(-5.5, -10.5), at(-12.5, 12.5), at(8, -8.5), schedule);
}

std::vector<double> solution(const std::string& scene) {
  SceneRun run = SceneRun::from_text(scene);
  std::vector<double> values;
  run.run_until(7200, [&] {
    for (const char* well : {"feed", "outlet", "drain"}) {
      values.push_back(run.quantity(fmt::format("wells.{}.pressure", well)) / 1e7);
      values.push_back(run.quantity(fmt::format("wells.{}.rate", well)) / 1e-5);
      values.push_back(run.quantity(fmt::format("wells.{}.binds_0_rate_1_pressure_2_shut", well)));
    }
    for (const char* place : {"one", "two", "rock"})
      values.push_back(run.quantity(fmt::format("wells.feed.{}.rate", place)) / 1e-5);
  });
  EXPECT_LT(balance_error(run), 1e-9);
  return values;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

/// Reference: symmetry, and that small changes of the data change the answer by little.
TEST(Wells, TwinsAgree) {
  const std::vector<double> here = solution(network(same));
  EXPECT_EQ(here[2], 0);                 // the feed begins with its rate
  EXPECT_EQ(here[here.size() - 10], 1);  // and ends at its limit
  EXPECT_LT(largest_difference(solution(network(turned)), here), 1e-8);
  EXPECT_LT(largest_difference(solution(network(mirrored)), here), 1e-8);
  EXPECT_LT(largest_difference(solution(network(same, "[{solve: [pore, conduit, wells]}]", 1e-5 * (1 + 1e-9))), here),
            1e-8);
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
