// The weight of a fluid that follows temperature and pressure: derivatives, rest, the onset of convection, convection.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "components/capabilities/fluid_fluxes.hpp"
#include "framework/config/input_error.hpp"
#include "tests/verification/derivatives.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

constexpr double pi = std::numbers::pi;

/// All derivatives by temperatures and pressures, against differences: fractures cross, touch and end in the rock and
/// on sides, with and without a temperature there.
std::string small(const std::string& flow, const std::string& heat, const std::string& law) {
  return fmt::format(R"(
geometry:
  box: {{x: [-1, 1], y: [-1, 1]}}
  fractures: {{a: {{points: [[-1, 0.1], [0.7, 0]]}}, b: {{points: [[0, -0.5], [0.1, 1]]}}}}
mesh: {{size: 0.6, fracture_size: 0.4}}
materials: {{viscosity: 1 Pa*s, permeability: {{along: 1 m^2, across: 0.3 m^2, angle: 20 deg}}, fluid_density: 20 kg/m^3, gravity: [0.3 m/s^2, -1 m/s^2],
  fluid_heat_capacity: 1.3 J/(m^3*K), conductivity: {{xx: 1 W/(m*K), yy: 0.4 W/(m*K)}}, heat_capacity: 0.8 J/(m^3*K)}}
components:
  pore: {{type: {}, storage: 0.7 1/Pa, boundary: {{left: {{pressure: "1 + y"}}, right: {{pressure: 1 Pa}}, top: {{flux: 0.1 m/s}}}}}}
  conduit: {{type: fracture_flow/tpfa, fluid_compressibility: 0.1 1/Pa, initial_aperture: 1 m, aperture_floor: 1 mm, boundary: {{left: {{pressure: 1 Pa}}, top: {{pressure: -1 Pa}}}}}}
  heat: {{type: {}, boundary: {{left: {{temperature: 2 K}}, top: {{heat_flux: 0.2 W/m^2}}}}}}
  water: {{type: fracture_heat/tpfa, aperture: 1 m, conductivity: 0.6 W/(m*K), heat_capacity: 0.5 J/(m^3*K), boundary: {{left: {{temperature: 1.5 K}}}}}}
couplers:
  - {{type: wall_exchange, between: [pore, conduit]}}
  - {{type: heat_advection, between: [pore, conduit, heat, water]}}
  - {{type: heat_exchange, between: [heat, water]}}
  - {{type: buoyancy, between: [pore, conduit, heat, water], {}}}
schedule: [{{solve: [pore, conduit, heat, water]}}]
time: {{end: 1 s, step: 1 s}}
)",
                     flow, heat, law);
}

TEST(Buoyancy, Derivatives) {
  const std::string rock = "heat.temperature", water = "water.temperature", p = "pore.pressure",
                    h = "pore.face_pressure", lambda = "pore.wall_flux", pi_ = "conduit.pressure", q = "conduit.flux";
  for (const std::string flow : {"matrix_flow/mpfa", "matrix_flow/tpfa", "matrix_flow/rt0", "matrix_flow/ntpfa"})
    for (const std::string law :
         {"law: exponential, fluid_expansion: 0.3 1/K, reference_temperature: 1 K, compressibility: 0.2 1/Pa",
          "law: linear, fluid_expansion: 0.1 1/K, reference_temperature: 1 K"}) {
      SCOPED_TRACE(flow + ", " + law);
      SceneRun run = SceneRun::from_text(small(flow, "matrix_heat/mpfa", law));
      std::vector<Spread> spreads = {{p, -1, 1}, {lambda, -1, 1}, {pi_, -1, 1},
                                     {q, -1, 1}, {rock, 1, 2},    {water, 1, 2}};
      std::vector<std::pair<std::string, std::string>> full = {
          {p, p}, {p, rock}, {lambda, rock}, {lambda, water}, {q, water}, {rock, rock}, {rock, p}};
      if (flow == "matrix_flow/rt0") {
        spreads.push_back({h, -1, 1});
        full.push_back({h, rock});
      }
      expect_derivatives(run, spreads, static_cast<int>(spreads.size()), full);
    }
}

/// A closed box of rock with fractures, insulated but for the temperature of its sides, which is linear along gravity;
/// `flow` and the mesh vary.
std::string closed(const std::string& flow, const std::string& mesh, const Point& gravity) {
  // T = 350 + 4 s, s = (gravity·x)/|gravity|; rho = 1000 (1 − 1e-3 (T − 350)): p = p_0 + 1000 |g| (s − 2e-3 s^2).
  const double size = gravity.norm();
  const std::string s = fmt::format("(({:.17g})*x + ({:.17g})*y)", gravity[0] / size, gravity[1] / size);
  const std::string t = fmt::format("(350 + 4*{}) K", s);
  const std::string p = fmt::format("(2e6 + 1e3*{:.17g}*({} - 2e-3*{}^2)) Pa", size, s, s);
  return fmt::format(R"(
geometry:
  box: {{x: [-5 m, 5 m], y: [-5 m, 5 m]}}
  fractures: {{a: {{points: [[-4 m, -2 m], [1 m, 1 m], [3 m, 1.5 m]]}}, b: {{points: [[-1 m, 3 m], [0.5 m, -3 m]]}}, c: {{points: [[2 m, -3 m], [2.6 m, 0 m], [5 m, 2 m]]}}}}
mesh: {0}
materials: {{viscosity: 1 mPa*s, fluid_compressibility: 4e-10 1/Pa, fluid_density: 1000 kg/m^3, gravity: [{1} m/s^2, {2} m/s^2],
  fluid_heat_capacity: 4e6 J/(m^3*K), fluid_expansion: 1e-3 1/K, conductivity: 2 W/(m*K)}}
components:
  pore: {{type: {3}, permeability: {{along: 1e-13 m^2, across: 4e-14 m^2, angle: 25 deg}}, porosity: 0.1, initial_pressure: "{5}"}}
  conduit: {{type: fracture_flow/tpfa, initial_aperture: 0.1 mm, initial_pressure: "{5}"}}
  heat: {{type: matrix_heat/mpfa, heat_capacity: 2e6 J/(m^3*K), initial_temperature: "{4}", boundary: {{left: {{temperature: "{4}"}}, right: {{temperature: "{4}"}}, top: {{temperature: "{4}"}}, bottom: {{temperature: "{4}"}}}}}}
  water: {{type: fracture_heat/tpfa, aperture: 0.1 mm, conductivity: 1e-15 W/(m*K), heat_capacity: 4e6 J/(m^3*K), initial_temperature: "{4}", boundary: {{right: {{temperature: "{4}"}}}}}}
couplers:
  - {{type: wall_exchange, between: [pore, conduit]}}
  - {{type: heat_advection, between: [pore, conduit, heat, water]}}
  - {{type: heat_exchange, between: [heat, water], conductance: 1e12 W/(m^2*K)}}
  - {{type: buoyancy, between: [pore, conduit, heat, water], reference_temperature: 350 K}}
schedule: [{{solve: [pore, conduit, heat, water]}}]
newton: {{residual: 1e-14, update: 1e-13}}
time: {{end: 10 day, step: 2 day}}
)",
                     mesh, gravity[0], gravity[1], flow, t, p);
}

/// The largest flux through faces and along fractures, over what the lightest fluid would have in the densest.
double unrest(const std::string& scene, double gravity) {
  SceneRun run = SceneRun::from_text(scene);
  run.run();
  double largest = 0;
  for (const auto& component : run.model().components()) {
    if (const auto* flow = dynamic_cast<const MatrixFluxes*>(component.get()))
      for (int f = 0; f < run.mesh().face_count(); ++f)
        largest = std::max(largest, std::abs(flow->face_fluxes()[f]) / run.mesh().face_measure[f] / 1e-10);
    if (const auto* flow = dynamic_cast<const FractureFluxes*>(component.get()))
      largest = std::max(largest, flow->flux().now().lpNorm<Eigen::Infinity>() / (1e-12 / 12e-3));
  }
  return largest / (gravity * 1000 * 1e-3 * 40);
}

/// Reference: fluid at rest, whose density is linear with height, has no flux; any mesh, tensor and direction.
TEST(Buoyancy, FluidWithALinearDensityStaysAtRest) {
  for (const std::string flow : {"matrix_flow/mpfa", "matrix_flow/rt0", "matrix_flow/ntpfa"})
    for (const Point& gravity : {Point(0, -10), Point(10, 0), Point(3, -9.5)}) {
      const double here = unrest(closed(flow, "{size: 1.2 m, fracture_size: 0.6 m}", gravity), gravity.norm());
      std::printf("%s, gravity (%g, %g): %.1e\n", flow.c_str(), gravity[0], gravity[1], here);
      EXPECT_LT(here, 1e-8);
    }
}

/// A square of 1 m in units without scale, impermeable: Ra = gravity (a density of 1000 with an expansion of 1e-3).
/// `hot` and `cold` sides have 1 K and 0 K, 0.5 K to either side of a density of 1000.
struct Square {
  std::string flow = "matrix_flow/mpfa", heat = "matrix_heat/mpfa";
  std::string mesh = "{kind: structured, cells: [20, 20], shape: quadrilaterals}";
  Point gravity = {0, -40};
  std::string hot = "bottom", cold = "top", temperature = "1 - y";
  double heat_capacity = 1;
  std::string schedule = "[{solve: [pore, heat]}]", time = "{end: 1 s, step: 0.1 s}";
  std::string text() const {
    return fmt::format(R"(
geometry: {{box: {{x: [0 m, 1 m], y: [0 m, 1 m]}}}}
mesh: {}
materials: {{viscosity: 1 Pa*s, fluid_density: 1000 kg/m^3, gravity: [{:.17g} m/s^2, {:.17g} m/s^2], fluid_heat_capacity: 1 J/(m^3*K), fluid_expansion: 1e-3 1/K}}
components:
  pore: {{type: {}, permeability: 1 m^2, storage: 1e-12 1/Pa, initial_pressure: "(1000*(({:.17g})*(x - 0.5) + ({:.17g})*(y - 0.5))) Pa"}}
  heat: {{type: {}, conductivity: 1 W/(m*K), heat_capacity: {} J/(m^3*K), initial_temperature: "({}) K", boundary: {{{}: {{temperature: 1 K}}, {}: {{temperature: 0 K}}}}}}
couplers:
  - {{type: heat_advection, between: [pore, heat]}}
  - {{type: buoyancy, between: [pore, heat], reference_temperature: 0.5 K}}
schedule: {}
time: {}
)",
                       mesh, gravity[0], gravity[1], flow, gravity[0], gravity[1], heat, heat_capacity, temperature,
                       hot, cold, schedule, time);
  }
};

std::string squares(int cells) {
  return fmt::format("{{kind: structured, cells: [{0}, {0}], shape: quadrilaterals}}", cells);
}

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
  in_turn.schedule = "[{iterate: {steps: [{solve: pore}, {solve: heat}], until: {relative: 1e-11, at_most: 100}}}]";
  EXPECT_LT((heated(in_turn, same) - together).lpNorm<Eigen::Infinity>(), 1e-7);
  in_turn.schedule = "[{iterate: {steps: [{solve: heat}, {solve: pore}], until: {relative: 1e-11, at_most: 100}}}]";
  EXPECT_LT((heated(in_turn, same) - together).lpNorm<Eigen::Infinity>(), 1e-7);
}

/// The largest error of the pressure in a column of 1000 m that is open at its top, Pa.
double column(int cells, const std::string& law, const std::function<double(double)>& exact) {
  SceneRun run = SceneRun::from_text(fmt::format(R"(
geometry: {{box: {{x: [0 m, 100 m], y: [0 m, 1000 m]}}, fractures: {{main: {{points: [[50 m, 0 m], [50 m, 1000 m]]}}}}}}
mesh: {{kind: structured, cells: [2, {}], shape: quadrilaterals}}
materials: {{viscosity: 1 mPa*s, fluid_compressibility: 4e-10 1/Pa, fluid_density: 1000 kg/m^3, gravity: [0 m/s^2, -10 m/s^2], conductivity: 2 W/(m*K), fluid_heat_capacity: 4e6 J/(m^3*K)}}
components:
  pore: {{type: matrix_flow/mpfa, permeability: 1e-13 m^2, porosity: 0.1, boundary: {{top: {{pressure: 0 Pa}}}}}}
  conduit: {{type: fracture_flow/tpfa, initial_aperture: 0.1 mm, boundary: {{top: {{pressure: 0 Pa}}}}}}
  heat: {{type: matrix_heat/mpfa, heat_capacity: 2e6 J/(m^3*K), initial_temperature: "(380 - 0.1*y) K", boundary: {{top: {{temperature: 280 K}}, bottom: {{temperature: 380 K}}}}}}
  water: {{type: fracture_heat/tpfa, aperture: 0.1 mm, conductivity: 2 W/(m*K), heat_capacity: 4e6 J/(m^3*K), initial_temperature: "(380 - 0.1*y) K", boundary: {{top: {{temperature: 280 K}}, bottom: {{temperature: 380 K}}}}}}
couplers:
  - {{type: wall_exchange, between: [pore, conduit]}}
  - {{type: heat_exchange, between: [heat, water]}}
  - {{type: buoyancy, between: [pore, conduit, heat, water], {}}}
schedule: [{{solve: [pore, conduit]}}, {{solve: [heat, water]}}]
time: {{end: 1e11 s, step: 5e10 s}}
)",
                                                 cells, law));
  run.run();
  double worst = 0;
  for (int c = 0; c < run.mesh().cell_count(); ++c)
    worst = std::max(worst, std::abs(run.field("pore.pressure")[c] - exact(1000 - run.mesh().cell_center[c][1])));
  for (int i = 0; i < run.mesh().fracture_cell_count(); ++i)
    worst = std::max(worst,
                     std::abs(run.field("conduit.pressure")[i] - exact(1000 - run.mesh().fracture_cells[i].center[1])));
  return worst;
}

/// Reference: the weight of the column above, in closed form, with 0.1 K/m.
TEST(Buoyancy, PressureOfAColumnIsItsWeight) {
  const double b = 0.002, g = 1e4, c = 1e-8;  // exaggerated
  const auto by_heat = [&](double z) { return g / (0.1 * b) * (1 - std::exp(-0.1 * b * z)); };
  const auto linear = [&](double z) { return g * (z - 0.05 * b * z * z); };
  const auto by_pressure = [&](double z) { return -std::log(1 - c * g * z) / c; };
  // exp(−c p) dp = g exp(−b (T − T_0)) dz
  const auto by_both = [&](double z) { return -std::log(1 - c * by_heat(z)) / c; };
  EXPECT_LT(column(10, "fluid_expansion: 0.002 1/K, reference_temperature: 280 K", linear), 1e-3);
  for (const auto& [law, exact] :
       {std::pair<std::string, std::function<double(double)>>{
            "law: exponential, fluid_expansion: 0.002 1/K, reference_temperature: 280 K", by_heat},
        {"law: exponential, compressibility: 1e-8 1/Pa", by_pressure},
        {"law: exponential, fluid_expansion: 0.002 1/K, reference_temperature: 280 K, compressibility: 1e-8 1/Pa",
         by_both}}) {
    const double coarse = column(10, law, exact), fine = column(20, law, exact);
    std::printf("%s: %.3g Pa, %.3g Pa, order %.2f\n", law.c_str(), coarse, fine, std::log2(coarse / fine));
    EXPECT_GT(std::log2(coarse / fine), 1.9);
    EXPECT_LT(fine, 1e-4 * exact(1000));
  }
}

/// Four fractures around a rectangle that is turned by an angle, sealed; water of 300 K on one side and of 340 K on the
/// other. What flows around, m^2/s.
double circulation(int cells, double angle) {
  const Point along(std::cos(angle), std::sin(angle)), up(-std::sin(angle), std::cos(angle));
  const auto at = [&](double a, double b) {
    const Point x = a * along + b * up;
    return fmt::format("[{:.17g} m, {:.17g} m]", x[0], x[1]);
  };
  const std::string across = fmt::format("({:.17g}*x + {:.17g}*y)", along[0], along[1]);
  const Point gravity = -10 * up;
  SceneRun run = SceneRun::from_text(fmt::format(R"(
geometry: {{box: {{x: [-8 m, 8 m], y: [-8 m, 8 m]}}, fractures: {{bottom: {{points: [{0}, {1}]}}, right: {{points: [{1}, {2}]}}, top: {{points: [{2}, {3}]}}, left: {{points: [{3}, {0}]}}}}}}
mesh: {{size: 4 m, fracture_size: {4} m}}
components:
  conduit: {{type: fracture_flow/tpfa, viscosity: 1 mPa*s, fluid_compressibility: 1e-14 1/Pa, initial_aperture: 0.1 mm, law: {{type: constant, transmissivity: 1e-13 m^3}}, gravity: [{5:.17g} m/s^2, {6:.17g} m/s^2], fluid_density: 1000 kg/m^3}}
  water: {{type: fracture_heat/tpfa, aperture: 0.1 mm, conductivity: 1e-20 W/(m*K), heat_capacity: 4e6 J/(m^3*K), initial_temperature: "(320 + 10*{7} + 5*({7}^2 - 4)) K"}}
couplers: [{{type: buoyancy, between: [conduit, water], fluid_density: 1000 kg/m^3, fluid_expansion: 1e-3 1/K, reference_temperature: 320 K}}]
schedule: [{{solve: conduit}}, {{solve: water}}]
time: {{end: 1 s, step: 1 s}}
)",
                                                 at(-2, -1), at(2, -1), at(2, 1), at(-2, 1), 2.0 / cells, gravity[0],
                                                 gravity[1], across));
  run.run();
  return run.field("conduit.flux").lpNorm<Eigen::Infinity>();
}

/// Reference: around the loop of 12 m the weight of 2 m of water whose densities differ by 40 kg/m^3 drives the flow
/// against the resistance of its length.
TEST(Buoyancy, FracturesCirculateLikeALoop) {
  const double exact = 40 * 10 * 2 / (12 / (1e-13 / 1e-3));
  for (const double angle : {0.0, 0.4}) {
    const double coarse = circulation(4, angle) / exact - 1, fine = circulation(8, angle) / exact - 1;
    std::printf("turned by %g: circulation off by %.2e and %.2e, order %.2f\n", angle, coarse, fine,
                std::log2(coarse / fine));
    EXPECT_LT(std::abs(fine), 0.01);
    EXPECT_GT(std::log2(coarse / fine), 1.8);
  }
}

/// Reference: density of water at 0.1 MPa (IAPWS; at 393 and 423 K that of the saturated liquid, which 0.1 to 0.4 MPa
/// change by 2e-4).
TEST(Buoyancy, WaterIsThatOfTheTables) {
  for (const auto& [temperature, density] : {std::pair{278.15, 999.97},
                                             {293.15, 998.21},
                                             {323.15, 988.04},
                                             {353.15, 971.79},
                                             {393.15, 943.11},
                                             {423.15, 917.01}}) {
    Square square;
    square.mesh = squares(2);
    square.time = "{end: 0.1 s, step: 0.1 s}";
    std::string text = square.text();
    const auto replace = [&](const std::string& from, const std::string& to) {
      ASSERT_NE(text.find(from), std::string::npos) << from;
      text.replace(text.find(from), from.size(), to);
    };
    replace("fluid_density: 1000 kg/m^3, ", "");
    replace(", fluid_expansion: 1e-3 1/K", "");
    replace("reference_temperature: 0.5 K", "law: water");
    replace("temperature: 1 K", fmt::format("temperature: {} K", temperature));
    replace("temperature: 0 K", fmt::format("temperature: {} K", temperature));
    replace("(1 - y) K", fmt::format("{} K", temperature));
    SceneRun run = SceneRun::from_text(text);
    run.run();
    std::vector<OutputField> fields;
    for (const Part* part : run.model().parts()) part->output(fields);
    for (const OutputField& field : fields)
      if (field.name == "buoyancy.density") {
        EXPECT_NEAR(field.values[0], density, 3e-4 * density);
      }
  }
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

TEST(Buoyancy, MistakesAreRefused) {
  const auto has = [](std::string text, const std::string& from, const std::string& to, const std::string& words) {
    ASSERT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.find(from), from.size(), to);
    try {
      SceneRun::from_text(text).run();
      ADD_FAILURE() << words;
    } catch (const std::exception& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  Square square;
  square.mesh = squares(2);
  const std::string text = square.text(), coupler = "{type: buoyancy, between: [pore, heat]";
  has(text, "gravity: [0 m/s^2, -40 m/s^2], ", "", "has no gravity");
  has(text, coupler, "{type: buoyancy, between: [pore]", "there is no temperature in the rock");
  has(text, coupler, "{type: buoyancy, between: [heat]", "there is no flow");
  has(text, ", fluid_expansion: 1e-3 1/K", "", "the density does not vary");
  has(text, coupler, coupler + ", law: water", "parameters of the linear law have no effect");
  has(text, "reference_temperature: 0.5 K", "law: water", "beyond the law for the density of water");
  has(text, "fluid_expansion: 1e-3 1/K", "fluid_expansion: 30 1/K", "the density of the fluid is");
  const std::string fractured = closed("matrix_flow/mpfa", "{size: 4 m, fracture_size: 2 m}", {0, -10});
  has(fractured, "buoyancy, between: [pore, conduit, heat, water]", "buoyancy, between: [pore, heat]",
      "the density of 'conduit' would stay constant");
}
}  // namespace
}  // namespace sprekk::testing
