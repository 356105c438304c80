// Heat that the fluid of wells carries: closed forms of fronts, and exact mixing.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "framework/config/input_error.hpp"
#include "tests/verification/balance_error.hpp"
#include "tests/verification/derivatives.hpp"

namespace sprekk::testing {
namespace {

/// Reference: a line source of the rate Q in rock without end that conducts. With A = c_f Q/(2 pi C) and D = k/C
///   T_t + (A/r) T_r = D (T_rr + T_r/r)
/// has the solution T = Gamma(nu, r^2/(4 D t))/Gamma(nu), nu = c_f Q/(4 pi k); for nu = 2 it is (1 + s) exp(−s). The
/// pressures on the sides are those of the line source, so that the flow is radial in the whole box.
TEST(WellsHeat, FrontAroundAWellIsThatOfTheLineSource) {
  constexpr double end = 5e5, diffusivity = 1e-6, width = 10.2;
  for (const std::string shape : {"quadrilaterals", "triangles"}) {
    double coarser = 0;
    for (const int cells : {17, 34 + 1, 68 + 1}) {
      SceneRun run = SceneRun::from_text(fmt::format(R"(
geometry: {{box: {{x: [-5.1 m, 5.1 m], y: [-5.1 m, 5.1 m]}}}}
mesh: {{kind: structured, cells: [{0}, {0}], shape: {1}}}
materials: {{viscosity: 1 mPa*s, conductivity: 2 W/(m*K), heat_capacity: 2e6 J/(m^3*K), fluid_heat_capacity: 4e6 J/(m^3*K)}}
components:
  pore:
    type: matrix_flow/mpfa
    permeability: 1e-12 m^2
    storage: 1e-20 1/Pa
    boundary:
      left: &side {{pressure: "(-2e3*log(sqrt(x^2 + y^2))) Pa"}}
      right: *side
      bottom: *side
      top: *side
  wells: {{type: wells/limited, wells: {{feed: {{at: [0 m, 0 m], rate: {2} m^2/s, index: 1e-9 m^2/(Pa*s)}}}}}}
  heat: {{type: matrix_heat/mpfa}}
couplers:
  - {{type: well_exchange, between: [wells, pore]}}
  - {{type: heat_advection, between: [wells, pore, heat], injected: {{feed: {{temperature: 1 K}}}}}}
schedule: [{{solve: [pore, wells]}}, {{solve: heat}}]
time: {{end: {3} s, step: {4} s}}
)",
                                                     cells, shape, 4e-6 * M_PI, end, end / cells / 1.2));
      run.run();
      const Mesh& mesh = run.mesh();
      Vector exact(mesh.cell_count()), areas(mesh.cell_count());
      double heat = 0;
      for (int c = 0; c < exact.size(); ++c) {
        const double s = mesh.cell_center[c].squaredNorm() / (4 * diffusivity * end);
        exact[c] = (1 + s) * std::exp(-s);
        areas[c] = mesh.cell_measure[c];
        heat += 2e6 * areas[c] * run.field("heat.temperature")[c];
      }
      const double error = relative_error(areas, run.field("heat.temperature"), exact);
      std::printf("%s, %d cells: error %.2e, order %.2f, heat %.2e\n", shape.c_str(), cells, error,
                  std::log2(coarser / error), heat / (4e6 * 4e-6 * M_PI * end) - 1);
      // Upwinding spreads heat as a conductivity of c_f |v| h/2 does: nu h/r of that of the rock.
      EXPECT_LT(error, width / cells / 2);
      EXPECT_NEAR(heat / (4e6 * 4e-6 * M_PI * end), 1, 1e-3);
      EXPECT_LT(balance_error(run, "heat"), 1e-12);
      if (coarser > 0) {
        EXPECT_GT(std::log2(coarser / error), 0.85);
      }
      coarser = error;
    }
  }
}

/// Reference: Lauwerier 1955 on both sides of a well that feeds a fracture in its middle, as in
/// configs/verification/lauwerier.yaml: each side has half of the rate.
TEST(WellsHeat, FractureThatAWellFeedsWarmsTheRockAsInLauwerier) {
  double coarser = 0;
  for (const int n : {1, 2, 4}) {
    SceneRun run = SceneRun::from_text(fmt::format(R"(
geometry:
  box: {{x: [-20 m, 20 m], y: [-4 m, 4 m]}}
  fractures: {{main: {{points: [[-20 m, 0 m], [20 m, 0 m]]}}}}
mesh: {{kind: structured, cells: [{}, {}], shape: quadrilaterals}}
materials: {{conductivity: {{xx: 2.5e-6 W/(m*K), yy: 2.5 W/(m*K)}}, heat_capacity: 2.5e6 J/(m^3*K), fluid_heat_capacity: 4e6 J/(m^3*K)}}
components:
  conduit:
    type: fracture_flow/tpfa
    viscosity: 1 mPa*s
    fluid_compressibility: 0 1/Pa
    initial_aperture: 0.1 mm
    law: {{type: constant, transmissivity: 1e-12 m^3}}
    boundary: {{left: {{pressure: 0 Pa}}, right: {{pressure: 0 Pa}}}}
  wells: {{type: wells/limited, wells: {{feed: {{at: [0 m, 0 m], fracture: main, rate: 2e-5 m^2/s}}}}}}
  heat: {{type: matrix_heat/tpfa}}
  water: {{type: fracture_heat/tpfa, aperture: 0.1 mm, conductivity: 0.6 W/(m*K), heat_capacity: 4e6 J/(m^3*K)}}
couplers:
  - {{type: well_exchange, between: [wells, conduit]}}
  - {{type: heat_advection, between: [wells, conduit, water], injected: {{feed: {{temperature: 1 K}}}}}}
  - {{type: heat_exchange, between: [heat, water], conductance: 1e9 W/(m^2*K)}}
schedule: [{{solve: [conduit, wells]}}, {{solve: [heat, water]}}]
time: {{end: 5e5 s, step: {} s}}
)",
                                                   40 * n + 1, 40 * n, 2e4 / n));
    run.run();
    const Mesh& mesh = run.mesh();
    Vector exact(mesh.fracture_cell_count());
    for (int i = 0; i < exact.size(); ++i) {
      const double x = std::abs(mesh.fracture_cells[i].center[0]), late = run.time() - x * 1e-4 / 1e-5;
      exact[i] = std::erfc(2.5 * x / 40 / std::sqrt(1e-6 * late));
    }
    const double error = relative_error(Vector::Ones(exact.size()), run.field("water.temperature"), exact);
    std::printf("%d cells: error %.2e, order %.2f\n", 40 * n + 1, error, std::log2(coarser / error));
    EXPECT_LT(error, 0.08 / n);
    EXPECT_LT(balance_error(run, "heat"), 1e-12);
    if (coarser > 0) {
      EXPECT_GT(std::log2(coarser / error), 0.85);
    }
    coarser = error;
  }
}

/// Three fractures with tight walls, each with its temperature and a pressure at its far end, which a well joins.
std::string three_pipes(const std::string& well, double end, const std::string& injected = "") {
  return fmt::format(R"(
geometry:
  box: {{x: [0 m, 10 m], y: [0 m, 8 m]}}
  fractures:
    low: {{points: [[0 m, 2 m], [8 m, 2 m]]}}
    middle: {{points: [[0 m, 4 m], [8 m, 4 m]]}}
    high: {{points: [[0 m, 6 m], [8 m, 6 m]]}}
mesh: {{kind: structured, cells: [10, 8], shape: quadrilaterals}}
components:
  conduit:
    type: fracture_flow/tpfa
    viscosity: 1 mPa*s
    fluid_compressibility: 0 1/Pa
    initial_aperture: "(if(y > 5, 0.1, if(y > 3, 0.2, 0.3))) mm"
    boundary: {{left: {{pressure: "(if(y > 5, 30, if(y > 3, 20, 10))) Pa"}}}}
  water:
    type: fracture_heat/tpfa
    aperture: "(if(y > 5, 0.1, if(y > 3, 0.2, 0.3))) mm"
    conductivity: 1e-30 W/(m*K)
    heat_capacity: 4e6 J/(m^3*K)
    initial_temperature: "(if(y > 5, 320, if(y > 3, 350, 300))) K"
    boundary: {{left: {{temperature: "(if(y > 5, 320, if(y > 3, 350, 300))) K"}}}}
  wells:
    type: wells/limited
    wells: {{w: {{{}, places: {{low: {{at: [7.5 m, 2 m], fracture: low}}, middle: {{at: [7.5 m, 4 m], fracture: middle}}, high: {{at: [7.5 m, 6 m], fracture: high}}}}}}}}
couplers:
  - {{type: well_exchange, between: [wells, conduit]}}
  - {{type: heat_advection, between: [wells, conduit, water], fluid_heat_capacity: 4e6 J/(m^3*K){}}}
schedule: [{{solve: [conduit, wells]}}, {{solve: water}}]
time: {{end: {} s, step: {} s}}
)",
                     well, injected.empty() ? "" : ", injected: {w: {temperature: " + injected + "}}", end, end / 20);
}

/// The fluid of a well that draws from three fractures has the mean of their temperatures, weighted by what flows; the
/// conductances of the pipes are T_k = a^3/(12 mu L), so that their rates are known, too.
TEST(WellsHeat, ProducedFluidIsTheMixture) {
  SceneRun run = SceneRun::from_text(three_pipes("pressure: -50 Pa", 1000));
  run.run();
  double flow = 0, heat = 0;
  for (const auto& [name, aperture, pressure, temperature] :
       {std::tuple{"low", 3e-4, 10.0, 300.0}, {"middle", 2e-4, 20.0, 350.0}, {"high", 1e-4, 30.0, 320.0}}) {
    const double rate = std::pow(aperture, 3) / 12e-3 / 7.5 * (pressure + 50);
    EXPECT_NEAR(run.quantity(fmt::format("wells.w.{}.rate", name)) / -rate, 1, 1e-10) << name;
    flow += rate;
    heat += rate * temperature;
  }
  EXPECT_NEAR(run.quantity("heat_advection.w.temperature"), heat / flow, 1e-9);
  EXPECT_LT(balance_error(run, "heat"), 1e-12);
}

/// A shut well that is open to three fractures: fluid flows in at the highest pressure and out at the others, and what
/// flows out has the temperature of the mixture, also where more is injected. In the end it fills the fractures.
TEST(WellsHeat, CrossflowGivesOutTheMixture) {
  for (const double injected : {0.0, 2e-10}) {
    SceneRun run =
        SceneRun::from_text(three_pipes(fmt::format("rate: {} m^2/s", injected), 4e7, injected > 0 ? "280 K" : ""));
    run.run();
    double flow = injected, heat = injected * 280, sum = 0;
    for (const auto& [name, temperature] : {std::pair{"low", 300.0}, {"middle", 350.0}, {"high", 320.0}}) {
      const double rate = run.quantity(fmt::format("wells.w.{}.rate", name));
      sum += rate;
      if (rate > 0) continue;
      flow -= rate;
      heat -= rate * temperature;
    }
    EXPECT_NEAR(sum, injected, 1e-9 * flow);
    EXPECT_GT(flow, 1.5 * injected);
    EXPECT_NEAR(run.quantity("heat_advection.w.temperature"), heat / flow, 1e-9);
    const int low = run.mesh().fractures[0].first_cell, count = run.mesh().fractures[0].cell_count;
    for (int i = 0; i < count - 1; ++i) EXPECT_NEAR(run.field("water.temperature")[low + i], heat / flow, 1e-6) << i;
    EXPECT_LT(balance_error(run, "heat"), 1e-12);
  }
}

/// All derivatives of heat by temperatures and by the rates of wells, against differences; with rates of both signs at
/// the places of one well, in rock and in a fracture.
TEST(WellsHeat, Derivatives) {
  for (const std::string rate : {"0.5", "-0.5"}) {
    SceneRun run = SceneRun::from_text(fmt::format(R"(
geometry:
  box: {{x: [-1, 1], y: [-1, 1]}}
  fractures: {{a: {{points: [[-1, 0.1], [0.7, 0]]}}}}
mesh: {{size: 0.6, fracture_size: 0.4}}
materials: {{viscosity: 1 Pa*s, permeability: 1 m^2, fluid_heat_capacity: 1.3 J/(m^3*K), conductivity: 1 W/(m*K), heat_capacity: 0.8 J/(m^3*K)}}
components:
  pore: {{type: matrix_flow/mpfa, storage: 0.7 1/Pa}}
  conduit: {{type: fracture_flow/tpfa, fluid_compressibility: 0.1 1/Pa, initial_aperture: 1 m}}
  heat: {{type: matrix_heat/mpfa}}
  water: {{type: fracture_heat/tpfa, aperture: 1 m, conductivity: 0.6 W/(m*K), heat_capacity: 0.5 J/(m^3*K)}}
  wells:
    type: wells/limited
    wells:
      both:
        rate: {} m^2/s
        places:
          one: {{at: [0.5, 0.5], index: 2 m^2/(Pa*s)}}
          two: {{at: [-0.5, -0.6], index: 2 m^2/(Pa*s)}}
          three: {{at: [0.3, 0.02], fracture: a}}
          four: {{at: [-0.6, 0.08], fracture: a, index: 3 m^2/(Pa*s)}}
      held: {{pressure: 1 Pa, at: [-0.5, 0.6], index: 3 m^2/(Pa*s)}}
couplers:
  - {{type: wall_exchange, between: [pore, conduit]}}
  - {{type: well_exchange, between: [wells, pore, conduit]}}
  - {{type: heat_advection, between: [wells, pore, conduit, heat, water], injected: {{both: {{temperature: 2.5 K}}}}}}
  - {{type: heat_exchange, between: [heat, water]}}
schedule: [{{solve: [pore, conduit, wells, heat, water]}}]
time: {{end: 1 s, step: 1 s}}
)",
                                                   rate));
    const std::string rock = "heat.temperature", water = "water.temperature", wells = "wells.rate";
    expect_derivatives(run, {{rock, 1, 2}, {water, 1, 2}, {wells, -1, 1}, {"pore.pressure", -1, 1}}, 2,
                       {{rock, rock}, {rock, water}, {rock, wells}, {water, rock}, {water, water}, {water, wells}});
  }
}

/// A well with a pressure, which lets fluid in that nobody has given a temperature, is noted; one that draws is not.
TEST(WellsHeat, FluidWithoutATemperatureIsNoted) {
  for (const bool injects : {true, false}) {
    SceneRun run = SceneRun::from_text(three_pipes(injects ? "pressure: 50 Pa" : "pressure: -50 Pa", 1000));
    EXPECT_TRUE(run.step());
    Notes notes;
    for (const Part* part : run.model().parts()) part->note_step(notes, {0, 50, 50});
    bool is_noted = false;
    for (const Notes::Note& note : notes.all())
      is_noted = is_noted || note.text.find("of fluid that has no temperature") != std::string::npos;
    EXPECT_EQ(is_noted, injects);
  }
}

/// What a scene may not ask for.
TEST(WellsHeat, MistakesAreRefused) {
  const auto has = [](const std::string& from, const std::string& to, const std::string& words) {
    std::string scene = three_pipes("rate: 2e-9 m^2/s", 100, "280 K"), said;
    const auto place = scene.find(from);
    ASSERT_NE(place, std::string::npos) << from;
    scene.replace(place, from.size(), to);
    try {
      SceneRun run = SceneRun::from_text(scene);
      run.run();
    } catch (const std::exception& error) {
      said = error.what();
    }
    EXPECT_NE(said.find(words), std::string::npos) << said;
  };
  has(", injected: {w: {temperature: 280 K}}", "", "injects has no temperature");
  has("injected: {w:", "injected: {v:", "'v'");
  has("between: [wells, conduit, water]", "between: [conduit, water]", "leaves out 'wells'");
}

}  // namespace
}  // namespace sprekk::testing
