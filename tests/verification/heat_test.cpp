// Heat that flowing fluid carries and rock conducts: closed forms, balances, and what must not matter.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <map>
#include <numbers>

#include "framework/config/input_error.hpp"
#include "tests/verification/balance_error.hpp"
#include "tests/verification/derivatives.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

double ogata_banks(double x, double t, double speed, double diffusivity) {
  const double spread = 2 * std::sqrt(diffusivity * t);
  return 0.5 * (std::erfc((x - speed * t) / spread) +
                std::exp(speed * x / diffusivity) * std::erfc((x + speed * t) / spread));
}

constexpr double speed = 5e-6, diffusivity = 1e-6;

/// How much upwinding and backward Euler spread heat, m^2/s.
double spread_of_scheme(double h, double dt) { return speed * h / 2 + speed * speed * dt / 2; }

/// Reference: Ogata and Banks 1961. The scheme is of first order; its error comes from the heat that it spreads, and is
/// a part of the spread.
TEST(Heat, FrontInAColumnIsThatOfOgataAndBanks) {
  for (const std::string type : {"matrix_heat/tpfa", "matrix_heat/mpfa"}) {
    double coarser = 0;
    for (const int cells : {80, 160, 320, 640}) {
      const double dt = 2e3 * 160 / cells;
      SceneRun run("verification/ogata_banks.yaml", {{"mesh.cells", fmt::format("[{}, 1]", cells)},
                                                     {"time.step", fmt::format("{} s", dt)},
                                                     {"components.heat.type", type}});
      run.run();
      EXPECT_LT(balance_error(run, "heat"), 1e-12);
      Vector exact(cells);
      for (int c = 0; c < cells; ++c)
        exact[c] = ogata_banks(run.mesh().cell_center[c][0], run.time(), speed, diffusivity);
      const double error = relative_error(Vector::Ones(cells), run.field("heat.temperature"), exact);
      std::printf("%s, %d cells: error %.2e, order %.2f\n", type.c_str(), cells, error, std::log2(coarser / error));
      EXPECT_LT(error, 0.25 * spread_of_scheme(4.0 / cells, dt) / diffusivity);
      if (coarser > 0) {
        EXPECT_GT(std::log2(coarser / error), 0.9);
      }
      coarser = error;
    }
  }
}

/// A pulse exp(−((x − 1.8)/0.3)^2) after some steps of backward Euler, with the diffusivity d, by a Fourier series over
/// a length from whose ends it is far away: each wave is multiplied by 1/(1 + dt (i U n + d n^2)) in each step.
double pulse(double x, int steps, double dt, double d) {
  const double width = 0.3, period = 8;
  std::complex<double> sum = 0;
  for (int k = -150; k <= 150; ++k) {
    const double n = 2 * std::numbers::pi * k / period;
    const std::complex<double> growth = 1.0 + dt * std::complex<double>(d * n * n, speed * n);
    sum += width * std::sqrt(std::numbers::pi) / period * std::exp(-n * n * width * width / 4) *
           std::polar(1.0, n * (x - 1.8)) * std::pow(growth, -steps);
  }
  return sum.real();
}

/// Reference: the series for backward Euler. Upwinding adds U h/2 to the diffusivity; what is left is of second order.
TEST(Heat, PulseMovesAndSpreads) {
  double coarser = 0;
  for (const int cells : {160, 320, 640}) {
    SceneRun run("verification/ogata_banks.yaml",
                 {{"mesh.cells", fmt::format("[{}, 1]", cells)},
                  {"time.end", "4e4 s"},
                  {"components.heat.boundary", "{left: {temperature: 0 K}}"},
                  {"components.heat.initial_temperature", "(exp(-((x - 1.8)/0.3)^2)) K"}});
    run.run();
    Vector exact(cells);
    for (int c = 0; c < cells; ++c)
      exact[c] = pulse(run.mesh().cell_center[c][0], run.steps(), 2e3, diffusivity + speed * 2.0 / cells);
    const double error = relative_error(Vector::Ones(cells), run.field("heat.temperature"), exact);
    std::printf("%d cells: error %.2e, order %.2f\n", cells, error, std::log2(coarser / error));
    if (coarser > 0) {
      EXPECT_GT(std::log2(coarser / error), 1.9);
    }
    coarser = error;
  }
}

double lauwerier(double x, double y, double t) {
  const double carried = 4e6 * 1e-5, diffusivity = 1e-6, late = t - x * 1e-4 / 1e-5;
  return late > 0 ? std::erfc((2.5 * x / carried + std::abs(y) / 2) / std::sqrt(diffusivity * late)) : 0;
}

/// Reference: Lauwerier 1955, in the fracture and in the rock.
TEST(Heat, FlowInAFractureWarmsTheRockAsInLauwerier) {
  std::vector<double> errors, errors_in_rock;
  for (const int n : {1, 2, 3}) {
    SceneRun run("verification/lauwerier.yaml", {{"mesh.cells", fmt::format("[{}, {}]", 40 * n, 80 * n)},
                                                 {"time.step", fmt::format("{} s", 1e4 / n)}});
    run.run();
    EXPECT_LT(balance_error(run, "heat"), 1e-12);
    const Mesh& mesh = run.mesh();
    Vector exact(mesh.fracture_cell_count()), in_rock(mesh.cell_count());
    for (int i = 0; i < exact.size(); ++i) exact[i] = lauwerier(mesh.fracture_cells[i].center[0], 0, run.time());
    for (int c = 0; c < in_rock.size(); ++c)
      in_rock[c] = lauwerier(mesh.cell_center[c][0], mesh.cell_center[c][1], run.time());
    errors.push_back(relative_error(Vector::Ones(exact.size()), run.field("water.temperature"), exact));
    errors_in_rock.push_back(relative_error(Vector::Ones(in_rock.size()), run.field("heat.temperature"), in_rock));
    std::printf("errors %.2e in the fracture, %.2e in the rock\n", errors.back(), errors_in_rock.back());
  }
  for (int k = 0; k < 2; ++k) {
    const double finer = std::log((k + 2.0) / (k + 1.0));
    EXPECT_GT(std::log(errors[k] / errors[k + 1]) / finer, 0.9);
    EXPECT_GT(std::log(errors_in_rock[k] / errors_in_rock[k + 1]) / finer, 0.9);
  }
  EXPECT_LT(errors.back(), 0.02);
}

/// Reference: what is conducted in, 2 W per metre and kelvin, for 1e-4 s; 1e-6 s move a temperature of 400 K by 35 of
/// its last digits, of which rounding takes half of one in each step.
TEST(Heat, StepsThatMoveTheLastDigitsOfATemperatureLoseNothing) {
  const std::string rock = "{type: matrix_heat/tpfa, conductivity: 1 W/(m*K), ",
                    water = "{type: fracture_heat/tpfa, aperture: 1 m, conductivity: 1 W/(m*K), ";
  for (const std::string& kind : {rock, water})
    for (const std::string side : {"left", "right", "bottom", "top"}) {
      const bool along_x = side == "left" || side == "right", in_rock = kind == rock;
      SceneRun run =
          SceneRun::from_text(fmt::format("geometry: {{box: {{{}: [0, 10], {}: [-1, 1]}}{}}}\n"
                                          "mesh: {{kind: structured, cells: {}, shape: quadrilaterals}}\n"
                                          "components: {{heat: {}heat_capacity: 1e6 J/(m^3*K), initial_temperature: "
                                          "400 K, boundary: {{{}: {{temperature: "
                                          "401 K}}}}}}}}\n"
                                          "schedule: [{{solve: heat}}]\ntime: {{end: 1e-4 s, step: 1e-6 s}}\n",
                                          along_x ? "x" : "y", along_x ? "y" : "x",
                                          in_rock ? ""
                                                  : fmt::format(", fractures: {{f: {{points: {}}}}}",
                                                                along_x ? "[[0, 0], [10, 0]]" : "[[0, 0], [0, 10]]"),
                                          along_x ? "[10, 2]" : "[2, 10]", kind, side));
      run.run();
      const double width = in_rock ? 2 : 1, area = in_rock ? 20 : 10;
      const double stored =
          1e6 * area / run.field("heat.temperature").size() * (run.field("heat.temperature").array() - 400).sum();
      EXPECT_NEAR(stored / (2 * width * 1e-4), 1, 0.5 / 35) << kind << side;
      EXPECT_LT(balance_error(run, "heat"), 0.5 / 35) << kind << side;
    }
}

/// A map of the plane by whole right angles and mirrors, and the sides that it takes to one another.
struct Twin {
  double xx, xy, yx, yy;
  std::string left, right, bottom, top;
  Point operator()(const Point& at) const { return {xx * at[0] + xy * at[1], yx * at[0] + yy * at[1]}; }
  std::string operator()(double x, double y) const {
    const Point at = (*this)(Point(x, y));
    return fmt::format("[{} m, {} m]", at[0], at[1]);
  }
};
const Twin same{1, 0, 0, 1, "left", "right", "bottom", "top"};
const Twin turned{0, -1, 1, 0, "bottom", "top", "right", "left"};
const Twin mirrored{-1, 0, 0, 1, "right", "left", "bottom", "top"};

/// Fractures that cross, a well in the rock, an injection, a prescribed pressure and open sides.
std::string network(const Twin& at, const std::string& more, const std::string& schedule, double injected = 330) {
  return fmt::format(R"(
geometry:
  box: {{x: [-4 m, 4 m], y: [-4 m, 4 m]}}
  fractures: {{a: {{points: [{}, {}]}}, b: {{points: [{}, {}]}}}}
mesh: {{kind: structured, cells: [16, 16], shape: quadrilaterals}}
materials: {{viscosity: 1 mPa*s, fluid_compressibility: 4e-10 1/Pa, fluid_heat_capacity: 4.2e6 J/(m^3*K)}}
components:
  pore:
    type: matrix_flow/tpfa
    permeability: 1e-13 m^2
    porosity: 0.1
    wells: {{doublet: {{at: {}, rate: 1e-6 m^2/s}}}}
    boundary: {{{}: {{pressure: 0.2 MPa}}, {}: {{pressure: 0 Pa}}}}
  conduit:
    type: fracture_flow/tpfa
    initial_aperture: 0.2 mm
    injection: {{inlet: {{fracture: a, at: {}, rate: 3e-6 m^2/s}}}}
    prescribed: {{outlet: {{fracture: b, at: {}, pressure: 0 Pa}}}}
  heat:
    type: matrix_heat/tpfa
    conductivity: 2.5 W/(m*K)
    heat_capacity: 2.2e6 J/(m^3*K)
    initial_temperature: 350 K
    boundary: {{{}: {{temperature: {} K}}}}
  water:
    type: fracture_heat/tpfa
    aperture: 0.2 mm
    conductivity: 0.6 W/(m*K)
    heat_capacity: 4.2e6 J/(m^3*K)
    initial_temperature: 350 K
couplers:
  - {{type: wall_exchange, between: [pore, conduit]}}
  - {{type: heat_advection, between: [pore, conduit, heat, water], injected: {{inlet: {{temperature: {} K}}, doublet: {{temperature: {} K}}, outlet: {{temperature: {} K}}}}}}
  - {{type: heat_exchange, between: [heat, water]}}
{}
schedule: {}
time: {{end: 10 day, step: 1 day}}
)",
                     at(-2, 1), at(3, 1), at(1, -3), at(1, 2), at(-3.25, -2.25), at.left, at.right, at(-1.75, 1),
                     at(1, -2.75), at.left, injected, injected, injected, injected, more, schedule);
}
const std::string in_turn = "[{solve: [pore, conduit]}, {solve: [heat, water]}]";
const std::string together = "[{solve: [pore, conduit, heat, water]}]";

Vector solution(const std::string& scene, const Twin& at) {
  SceneRun run = SceneRun::from_text(scene);
  run.run();
  EXPECT_LT(balance_error(run, "heat"), 1e-12);
  const Mesh& mesh = run.mesh();
  // In the order of the places before they were turned.
  const auto before = [&](const Point& x) {
    return std::pair(std::lround(1e3 * (at.xx * x[0] + at.yx * x[1])),
                     std::lround(1e3 * (at.xy * x[0] + at.yy * x[1])));
  };
  std::map<std::pair<long, long>, double> rock, fractures;
  for (int c = 0; c < mesh.cell_count(); ++c) rock[before(mesh.cell_center[c])] = run.field("heat.temperature")[c];
  for (int i = 0; i < mesh.fracture_cell_count(); ++i)
    fractures[before(mesh.fracture_cells[i].center)] = run.field("water.temperature")[i];
  Vector all(rock.size() + fractures.size());
  int k = 0;
  for (const auto& part : {rock, fractures})
    for (const auto& [place, temperature] : part) all[k++] = temperature;
  return all;
}

double largest(const Vector& difference) { return difference.lpNorm<Eigen::Infinity>(); }

/// Reference: symmetry, and that small changes of the data change the answer by little. The answer spreads over 20 K.
TEST(Heat, TwinsHaveTheSameTemperatures) {
  const Vector here = solution(network(same, "", in_turn), same);
  EXPECT_GT(here.maxCoeff() - here.minCoeff(), 15);
  EXPECT_LT(largest(solution(network(turned, "", in_turn), turned) - here), 1e-9);
  EXPECT_LT(largest(solution(network(mirrored, "", in_turn), mirrored) - here), 1e-9);
  EXPECT_LT(largest(solution(network(same, "", in_turn, 330 * (1 + 1e-9)), same) - here), 2 * 330e-9);
}

/// Reference: temperatures act on nothing here, so a split is exact.
TEST(Heat, InTurnIsMonolithic) {
  EXPECT_LT(largest(solution(network(same, "", in_turn), same) - solution(network(same, "", together), same)), 1e-8);
}

/// Reference: the maximum principle, and the balance also where heat is solved before the flow, or in substeps.
TEST(Heat, StaysWithinItsDataInAnySchedule) {
  for (const std::string& schedule :
       {in_turn, together, std::string("[{solve: [heat, water]}, {solve: [pore, conduit]}]"),
        std::string("[{solve: [pore, conduit]}, {subcycle: {count: 4, steps: [{solve: [heat, water]}]}}]"),
        std::string("[{subcycle: {count: 4, steps: [{solve: [pore, conduit]}]}}, {solve: [heat, water]}]")}) {
    const Vector all = solution(network(same, "", schedule), same);
    EXPECT_GT(all.minCoeff(), 330 - 1e-9) << schedule;
    EXPECT_LT(all.maxCoeff(), 350 + 1e-9) << schedule;
    const Vector uniform = solution(network(same, "", schedule, 350), same);
    EXPECT_LT(largest(uniform - Vector::Constant(uniform.size(), 350)), 1e-10) << schedule;
  }
}

/// Reference: as before. The viscosity of a cell becomes up to 55 times larger from one step to the next, and a side
/// has another pressure after five days: fluxes of the earlier pressures with these data would balance no more.
TEST(Heat, IsCarriedByTheFluxesThatTheFlowWasSolvedFor) {
  const std::string viscosity =
      "  - {type: thermal_viscosity, between: [pore, conduit, heat, water], law: exponential, reference_viscosity: "
      "1 mPa*s, reference_temperature: 350 K, decay: 0.2 1/K}";
  Vector expected;
  for (const std::string& schedule :
       {in_turn, std::string("[{solve: [heat, water]}, {solve: [pore, conduit]}]"),
        std::string("[{solve: [pore, conduit]}, {subcycle: {count: 4, steps: [{solve: [heat, water]}]}}]")})
    for (const Twin& at : {same, turned, mirrored}) {
      const auto with = [&](double injected) {
        std::string scene = network(at, viscosity, schedule, injected);
        const std::string constant = "{pressure: 0.2 MPa}";
        scene.replace(scene.find(constant), constant.size(),
                      "{pressure: [{value: 0.2 MPa, to: 5 day}, {value: 2 MPa, from: 5 day}]}");
        scene.replace(scene.find("end: 10 day"), 11, "end: 40 day");
        return solution(scene, at);
      };
      const Vector all = with(330);
      EXPECT_LT(largest(all - with(330 * (1 + 1e-9))), 2 * 330e-9) << schedule;
      EXPECT_GT(all.minCoeff(), 330 - 1e-9) << schedule;
      EXPECT_LT(all.maxCoeff(), 350 + 1e-9) << schedule;
      EXPECT_GT(all.maxCoeff() - all.minCoeff(), 5) << schedule;
      if (expected.size() == 0) expected = all;
      EXPECT_LT(largest(all - expected), 0.5) << schedule;  // of first order in the step
    }
}

/// All derivatives of heat by temperatures and fluxes, against differences; fractures cross, touch and end in the rock
/// and on sides.
TEST(Heat, Derivatives) {
  SceneRun run = SceneRun::from_text(R"(
geometry:
  box: {x: [-1, 1], y: [-1, 1]}
  fractures: {a: {points: [[-1, 0.1], [0.7, 0]]}, b: {points: [[0, -0.5], [0.1, 1]]}}
mesh: {size: 0.6, fracture_size: 0.4}
materials: {viscosity: 1 Pa*s, permeability: 1 m^2, fluid_heat_capacity: 1.3 J/(m^3*K), conductivity: {xx: 1 W/(m*K), yy: 0.4 W/(m*K)}, heat_capacity: 0.8 J/(m^3*K)}
components:
  pore: {type: matrix_flow/mpfa, storage: 0.7 1/Pa, boundary: {left: {pressure: 1 Pa}, top: {flux: 0.1 m/s}}, wells: {w: {at: [0.5, 0.5], rate: 0.3 m^2/s}}}
  conduit: {type: fracture_flow/tpfa, fluid_compressibility: 0.1 1/Pa, initial_aperture: 1 m, boundary: {left: {pressure: 1 Pa}}, injection: {i: {at: [0.3, 0.02], rate: 0.2 m^2/s}}}
  heat: {type: matrix_heat/mpfa, boundary: {left: {temperature: 2 K}, top: {heat_flux: 0.2 W/m^2}}, source: 0.3 W/m^3}
  water: {type: fracture_heat/tpfa, aperture: 1 m, conductivity: 0.6 W/(m*K), heat_capacity: 0.5 J/(m^3*K), boundary: {left: {temperature: 1.5 K}, top: {temperature: 1 K}}}
couplers:
  - {type: wall_exchange, between: [pore, conduit]}
  - {type: heat_advection, between: [pore, conduit, heat, water], injected: {w: {temperature: 2 K}, i: {temperature: 0.5 K}}}
  - {type: heat_exchange, between: [heat, water]}
schedule: [{solve: [pore, conduit, heat, water]}]
time: {end: 1 s, step: 1 s}
)");
  const std::string rock = "heat.temperature", walls = "heat.wall_heat_flux", water = "water.temperature";
  expect_derivatives(run,
                     {{rock, 1, 2},
                      {walls, -1, 1},
                      {water, 1, 2},
                      {"pore.pressure", -1, 1},
                      {"pore.wall_flux", -1, 1},
                      {"conduit.flux", -1, 1}},
                     3,
                     {{rock, rock},
                      {rock, walls},
                      {rock, water},
                      {rock, "pore.pressure"},
                      {rock, "pore.wall_flux"},
                      {walls, rock},
                      {walls, walls},
                      {walls, water},
                      {water, rock},
                      {water, walls},
                      {water, water},
                      {water, "pore.wall_flux"},
                      {water, "conduit.flux"}});
}

/// Fluid that leaves the fracture through its walls for rock whose heat is not modelled, and comes back: the balance
/// counts it as what passes the boundary.
TEST(Heat, OfFracturesAloneIsBalanced) {
  std::string scene = network(same, "", "[{solve: [pore, conduit]}, {solve: water}]");
  const auto drop = [&](const std::string& from, const std::string& to) {
    const auto first = scene.find(from);
    scene.erase(first, scene.find(to, first) - first);
  };
  drop("  heat:\n", "  water:\n");
  drop("  - {type: heat_exchange", "\nschedule");
  drop("heat, water], injected", "water], injected");
  drop("doublet: {temperature", "outlet: {temperature");
  SceneRun run = SceneRun::from_text(scene);
  run.run();
  EXPECT_LT(balance_error(run, "heat"), 1e-12);
}

/// The scene of the gallery, its first two years: the maximum principle, the balance, and that water which comes out is
/// never colder than what is injected nor warmer than before.
TEST(Heat, DoubletCoolsTheRock) {
  SceneRun run("tutorial/heat_doublet.yaml", {{"time.end", "720 day"}});
  double before = 430;
  run.run_until(720 * 86400.0, [&] {
    const double outlet = run.quantity("heat_advection.outlet.temperature");
    EXPECT_LE(outlet, before);
    before = outlet;
    EXPECT_GE(run.field("water.temperature").minCoeff(), 330 - 1e-9);
    EXPECT_LE(run.field("water.temperature").maxCoeff(), 430 + 1e-9);
  });
  EXPECT_LT(before, 429);
  EXPECT_GT(before, 400);
  EXPECT_LT(balance_error(run, "heat"), 1e-9);
}

/// Scenes that are refused, and the messages.
TEST(Heat, MistakesAreRefused) {
  const auto message = [](const std::string& scene) -> std::string {
    try {
      SceneRun run = SceneRun::from_text(scene);
      run.run();
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  };
  const auto has = [&](const std::string& scene, const std::string& words) {
    const std::string said = message(scene);
    EXPECT_NE(said.find(words), std::string::npos) << said;
  };
  has(network(same, "", "[{solve: [pore, conduit]}, {solve: heat}, {solve: water}]"),
      "'heat' is solved without 'water'");
  has(network(same, "  - {type: heat_advection, between: [heat, water], fluid_heat_capacity: 1 J/(m^3*K)}", in_turn),
      "has no flow that carries heat");
  // Fluid that leaves could store more heat than the rock with all of its fluid.
  std::string drained = network(same, "", in_turn);
  drained.replace(drained.find("heat_capacity: 2.2e6"), 20, "heat_capacity: 2.2e0");
  drained.replace(drained.find("    porosity: 0.1"), 17, "    initial_pressure: 10 MPa\n    porosity: 0.1");
  has(drained, "that of the fluid that has left it");
  std::string unknown = network(same, "", in_turn);
  unknown.replace(unknown.find("{inlet: {temperature"), 7, "{inlat:");
  has(unknown, "inlat");
}

}  // namespace
}  // namespace sprekk::testing
