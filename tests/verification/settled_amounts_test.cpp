// Amounts that stay while the start is settled, and what is counted from there, against closed forms.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

using ::testing::HasSubstr;

constexpr double year = 31557600;  // s

Vector stress_of(SceneRun& run) {
  for (const OutputField& field : run.model().output())
    if (field.name == "rock.stress") return field.values;
  throw std::logic_error("no stress");
}

struct Kind {
  std::string flow, rock, mesh;
  bool turned = false;
  double scale = 1;  ///< of the load
};

std::string squares(const std::string& cells) {
  return "kind: structured, shape: quadrilaterals, cells: [" + cells + "]";
}

/// A column of 100 m by 1000 m that is closed all around, under a load q on its top.
std::string column(const Kind& kind, const std::string& list, const std::string& source = "") {
  const bool t = kind.turned;
  return fmt::format(R"(
geometry: {{box: {{x: {0}, y: {1}}}}}
mesh: {{{2}}}
components:
  pore: {{type: {3}, permeability: 1e-15 m^2, viscosity: 1 mPa*s, storage: 1e-10 1/Pa{4}}}
  rock:
    type: {5}
    young_modulus: 10 GPa
    poisson_ratio: 0.25
    boundary: {{{6}: {{displacement_normal: 0 m}}, {7}: {{displacement_normal: 0 m}}, {8}: {{displacement_normal: 0 m}}, {9}: {{normal_stress: {10:.17g} MPa}}}}
couplers: [{{type: biot, between: [pore, rock], biot_coefficient: 0.8}}]
start: {{settle: {11}}}
schedule: [{{solve: [pore, rock]}}]
time: {{end: 10 year, step: 5 year}}
)",
                     t ? "[0 m, 1000 m]" : "[0 m, 100 m]", t ? "[0 m, 100 m]" : "[-1000 m, 0 m]", kind.mesh, kind.flow,
                     source, kind.rock, t ? "bottom" : "left", t ? "top" : "right", t ? "right" : "bottom",
                     t ? "left" : "top", -10 * kind.scale, list);
}

/// Reference: undrained rock that cannot widen: p = alpha q/(M S*), M = lambda + 2 G, S* = S + alpha^2/M; the total
/// stress along the column is −q, and that across it nu/(1 − nu) of the effective one.
TEST(SettledAmounts, AClosedColumnHasItsUndrainedPressure) {
  const std::string mpsa = "poromechanics/mpsa", fem = "poromechanics/fem", upright = squares("2, 10");
  const std::vector<Kind> kinds = {{"matrix_flow/mpfa", mpsa, upright},
                                   {"matrix_flow/mpfa", fem, upright},
                                   {"matrix_flow/tpfa", mpsa, upright},
                                   {"matrix_flow/rt0", fem, upright},
                                   {"matrix_flow/ntpfa", fem, upright},
                                   {"matrix_flow/mpfa", mpsa, "size: 70 m"},
                                   {"matrix_flow/mpfa", fem, "size: 70 m"},
                                   {"matrix_flow/mpfa", mpsa, squares("10, 2"), true},
                                   {"matrix_flow/mpfa", mpsa, upright, false, 1 + 1e-9}};
  for (const Kind& kind : kinds) {
    SceneRun run = SceneRun::from_text(column(kind, "[pore, rock]"));
    const double modulus = 12e9, q = 10e6 * kind.scale, pressure = 0.8 * q / (modulus * (1e-10 + 0.64 / modulus));
    const double across = (-q + 0.8 * pressure) / 3 - 0.8 * pressure;
    const auto expect_state = [&] {
      const Vector stress = stress_of(run);
      double pressure_error = 0, stress_error = 0;
      for (int c = 0; c < run.mesh().cell_count(); ++c) {
        const int along = kind.turned ? 0 : 1;
        pressure_error = std::max(pressure_error, std::abs(run.field("pore.pressure")[c] / pressure - 1));
        stress_error = std::max({stress_error, std::abs(stress[3 * c + along] + q) / q,
                                 std::abs(stress[3 * c + 1 - along] - across) / q, std::abs(stress[3 * c + 2]) / q});
      }
      std::printf("%s %s: pressure off by %.1e, stress by %.1e\n", kind.flow.c_str(), kind.rock.c_str(), pressure_error,
                  stress_error);
      EXPECT_LT(pressure_error, 1e-11);
      EXPECT_LT(stress_error, 1e-11);
      EXPECT_LT(run.field("rock.displacement").lpNorm<Eigen::Infinity>(), 1e-12);  // 0.2 m while it was settled
    };
    expect_state();
    run.run();
    expect_state();
    EXPECT_LT(std::abs(run.quantity("fluid_stored")), 1e-10);
  }
}

TEST(SettledAmounts, FluidWithoutAWayOutHasNoStateAtRest) {
  const std::string well = ", wells: {w: {at: [50 m, -500 m], rate: 1e-6 m^2/s}}";
  try {
    SceneRun run =
        SceneRun::from_text(column({"matrix_flow/mpfa", "poromechanics/mpsa", squares("2, 10")}, "[pore, rock]", well));
    FAIL() << "settled";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("grows without end: what is brought in has no way out"));
  }
}

/// Reference: a free body that is heated has the temperature of its sides and no stress, whatever the first step is.
TEST(SettledAmounts, AHeatedBodyThatMayExpandHasNoStress) {
  for (const std::string rock : {"poromechanics/mpsa", "poromechanics/fem"})
    for (const double step : {1e3, 1e5, 1e7}) {
      SceneRun run = SceneRun::from_text(fmt::format(R"(
geometry: {{box: {{x: [0 m, 2 m], y: [0 m, 1 m]}}}}
mesh: {{size: 0.5 m}}
materials: {{conductivity: 3 W/(m*K), heat_capacity: 2e6 J/(m^3*K), young_modulus: 20 GPa, poisson_ratio: 0.25, expansion: 1e-5 1/K}}
components:
  heat:
    type: matrix_heat/mpfa
    initial_temperature: 300 K
    boundary: {{left: {{temperature: 350 K}}, right: {{temperature: 350 K}}, top: {{temperature: 350 K}}, bottom: {{temperature: 350 K}}}}
  rock: {{type: {0}, boundary: {{left: {{displacement_x: 0}}, bottom: {{displacement_y: 0}}}}}}
couplers: [{{type: thermal_stress, between: [heat, rock]}}]
schedule: [{{solve: heat}}, {{solve: rock}}]
time: {{end: {2} s, step: {1} s}}
start: {{settle: [heat, rock]}}
)",
                                                     rock, step, 3 * step));
      for (const bool is_later : {false, true}) {
        if (is_later) run.run();
        EXPECT_LT((run.field("heat.temperature").array() - 350).matrix().lpNorm<Eigen::Infinity>(), 1e-9);
        EXPECT_LT(stress_of(run).lpNorm<Eigen::Infinity>(), 1e-2) << rock << step;  // 20 MPa if it could not expand
        EXPECT_LT(run.field("rock.displacement").lpNorm<Eigen::Infinity>(), 1e-14);
      }
    }
}

/// A sealed fracture across a column under −5 MPa, with fluid of 6 MPa.
std::string open_fracture(const std::string& rock, const std::string& list) {
  return fmt::format(R"(
geometry: {{box: {{x: [0 m, 1 m], y: [-10 m, 10 m]}}, fractures: {{f: {{points: [[0 m, 0 m], [1 m, 0 m]]}}}}}}
mesh: {{kind: structured, shape: quadrilaterals, cells: [4, 8]}}
components:
  rock:
    type: {0}
    young_modulus: 20 GPa
    poisson_ratio: 0.25
    initial_stress: {{xx: -5 MPa, yy: -5 MPa, xy: 0 MPa}}
    boundary: {{bottom: {{displacement: [0, 0]}}, left: {{displacement_x: 0}}, right: {{displacement_x: 0}}, top: {{displacement: [0, 0]}}}}
  conduit: {{type: fracture_flow/tpfa, viscosity: 1 mPa*s, fluid_compressibility: 4e-10 1/Pa, initial_aperture: 1 mm, initial_pressure: 6 MPa, law: {{type: constant, transmissivity: 1e-9 m^3}}}}
  contact: {{type: contact/coulomb, friction: 0.6}}
couplers:
  - {{type: aperture, between: [contact, conduit]}}
  - {{type: wall_traction, between: [rock, contact, conduit]}}
schedule: [{{solve: [rock, contact, conduit]}}]
time: {{end: 3 s, step: 1 s}}
start: {{settle: {1}}}
)",
                     rock, list);
}

/// Reference: 1 MPa of overpressure shortens 2 x 10 m of rock with M = 24 GPa by 0.8333 mm, which the walls part. Held
/// fluid keeps its pressure and fills the fracture; fluid that is settled with them keeps its amount.
TEST(SettledAmounts, FluidOfAnOpenFractureKeepsItsPressureOrItsAmount) {
  for (const std::string rock : {"poromechanics/mpsa", "poromechanics/fem"}) {
    SceneRun held = SceneRun::from_text(open_fracture(rock, "[rock, contact]"));
    const double opening = 1e6 * 20 / 24e9;
    for (const bool is_later : {false, true}) {
      if (is_later) held.run();
      for (int i = 0; i < held.mesh().fracture_cell_count(); ++i) {
        EXPECT_NEAR(held.field("conduit.pressure")[i], 6e6, 1e-3) << rock << is_later;
        EXPECT_NEAR(held.field("conduit.aperture")[i], 1e-3 + opening, 1e-13) << rock << is_later;
      }
    }
    SceneRun settled = SceneRun::from_text(open_fracture(rock, "[rock, contact, conduit]"));
    const double before = settled.field("conduit.pressure")[0], opened = settled.field("contact.jump")[0];
    EXPECT_NEAR(opened, (before - 5e6) * 20 / 24e9, 1e-13);
    EXPECT_LT(before, 5.001e6);
    settled.run();
    EXPECT_NEAR(settled.field("conduit.pressure")[0], before, 1e-2);
    EXPECT_NEAR(settled.field("contact.jump")[0], opened, 1e-14);
  }
}

/// Reference: two flows that share a closed box come to the mean of their pressures, weighted by what they store.
TEST(SettledAmounts, FlowsBesideEachOtherShareTheirFluid) {
  SceneRun run = SceneRun::from_text(R"(
geometry:
  box: {x: [0 m, 10 m], y: [0 m, 10 m]}
  regions:
    low: {polygon: [[0 m, 0 m], [10 m, 0 m], [10 m, 5 m], [0 m, 5 m]]}
    high: {polygon: [[0 m, 5 m], [10 m, 5 m], [10 m, 10 m], [0 m, 10 m]]}
mesh: {kind: structured, shape: quadrilaterals, cells: [4, 4]}
components:
  pore: {type: matrix_flow/mpfa, regions: [low], permeability: 1e-14 m^2, viscosity: 1 mPa*s, storage: 1e-10 1/Pa}
  beside: {type: matrix_flow/mpfa, regions: [high], permeability: 1e-18 m^2, viscosity: 1 mPa*s, storage: 3e-10 1/Pa, initial_pressure: 1 MPa}
couplers: [{type: border_exchange, between: [pore, beside]}]
start: {settle: [pore, beside]}
schedule: [{solve: [pore, beside]}]
time: {end: 10 year, step: 5 year}
)");
  for (const bool is_later : {false, true}) {
    if (is_later) run.run();
    for (int c = 0; c < run.mesh().cell_count(); ++c) {
      const bool is_low = run.mesh().cell_center[c][1] < 5;
      EXPECT_NEAR(run.field(is_low ? "pore.pressure" : "beside.pressure")[c], 0.75e6, 1e-4) << is_later;
    }
  }
}

/// Reference: two flows in one rock, that of fractures and that of blocks, come to the pressure of the side.
TEST(SettledAmounts, FlowsInOneRockComeToThePressureOfTheSide) {
  SceneRun run = SceneRun::from_text(R"(
geometry: {box: {x: [0 m, 10 m], y: [0 m, 10 m]}}
mesh: {kind: structured, shape: quadrilaterals, cells: [4, 4]}
components:
  pore: {type: matrix_flow/mpfa, permeability: 1e-14 m^2, viscosity: 1 mPa*s, storage: 1e-10 1/Pa, boundary: {left: {pressure: 2 MPa}}}
  blocks: {type: matrix_flow/mpfa, permeability: 1e-18 m^2, viscosity: 1 mPa*s, storage: 3e-10 1/Pa, initial_pressure: 1 MPa}
couplers: [{type: matrix_exchange, between: [pore, blocks], exchange: 1e-12 1/(Pa*s)}]
start: {settle: [pore, blocks]}
schedule: [{solve: [pore, blocks]}]
time: {end: 10 year, step: 5 year}
)");
  for (const bool is_later : {false, true}) {
    if (is_later) run.run();
    for (const char* name : {"pore.pressure", "blocks.pressure"})
      EXPECT_LT((run.field(name).array() - 2e6).matrix().lpNorm<Eigen::Infinity>(), 1e-4) << name << is_later;
  }
}

/// Reference: what a well injects leaves by the side that lets it out, from the first step on: nothing is stored.
TEST(SettledAmounts, AWellStartsInSteadyFlow) {
  SceneRun run = SceneRun::from_text(R"(
geometry: {box: {x: [0 m, 10 m], y: [0 m, 10 m]}}
mesh: {kind: structured, shape: quadrilaterals, cells: [5, 5]}
components:
  pore: {type: matrix_flow/mpfa, permeability: 1e-14 m^2, viscosity: 1 mPa*s, storage: 1e-10 1/Pa, boundary: {left: {pressure: 0 Pa}}}
  wells: {type: wells/limited, wells: {w: {at: [5 m, 5 m], rate: 1e-6 m^2/s, highest_pressure: 100 MPa, radius: 0.1 m}}}
couplers: [{type: well_exchange, between: [pore, wells]}]
start: {settle: [pore, wells]}
schedule: [{solve: [pore, wells]}]
time: {end: 10 day, step: 5 day}
)");
  const Vector pressure = run.field("pore.pressure");
  const double in_well = run.field("wells.pressure")[0];
  EXPECT_GT(pressure.maxCoeff(), 1e4);
  run.run();
  EXPECT_LT((run.field("pore.pressure") - pressure).lpNorm<Eigen::Infinity>(), 1e-9 * in_well);
  EXPECT_NEAR(run.field("wells.pressure")[0] / in_well, 1, 1e-9);
  EXPECT_NEAR(run.quantity("pore.left.outflow") / 1e-6, 1, 1e-9);
  EXPECT_NEAR(run.quantity("fluid_stored") / run.quantity("fluid_injected"), 0, 1e-9);
}

}  // namespace
}  // namespace sprekk::testing
