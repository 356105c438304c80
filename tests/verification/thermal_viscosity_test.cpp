// The viscosity of a fluid that follows its temperature.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

/// A column of 1 m with a temperature that stays, and a fracture along it whose walls are sealed; the same Darcy
/// velocity, and flux, passes both.
std::string column(int cells, const std::string& temperature, const std::string& law) {
  return fmt::format(R"(
geometry: {{box: {{x: [0 m, 1 m], y: [-0.1 m, 0.1 m]}}, fractures: {{main: {{points: [[0 m, 0 m], [1 m, 0 m]]}}}}}}
mesh: {{kind: structured, cells: [{0}, 2], shape: quadrilaterals}}
materials: {{viscosity: 7 Pa*s, fluid_compressibility: 0 1/Pa}}
components:
  pore: {{type: matrix_flow/mpfa, permeability: 1e-13 m^2, storage: 0 1/Pa, boundary: {{left: {{flux: -1e-6 m/s}}, right: {{pressure: 0 Pa}}}}}}
  conduit:
    type: fracture_flow/tpfa
    initial_aperture: 0.1 mm
    law: {{type: constant, transmissivity: 1e-14 m^3}}
    boundary: {{right: {{pressure: 0 Pa}}}}
    injection: {{i: {{at: [0 m, 0 m], rate: 1e-7 m^2/s}}}}
  heat: {{type: matrix_heat/mpfa, conductivity: 1e-20 W/(m*K), heat_capacity: 2e6 J/(m^3*K), initial_temperature: {1}}}
  water: {{type: fracture_heat/tpfa, aperture: 0.1 mm, conductivity: 1e-20 W/(m*K), heat_capacity: 4e6 J/(m^3*K), initial_temperature: {1}}}
couplers: [{{type: thermal_viscosity, between: [pore, conduit, heat, water], {2}}}]
schedule: [{{solve: [pore, conduit]}}, {{solve: heat}}, {{solve: water}}]
time: {{end: 2 s, step: 1 s}}
)",
                     cells, temperature, law);
}

/// The largest error of the pressure in rock and fracture, over the largest pressure; 1e7 Pa/m for 1 Pa s.
double pressure_error(int cells) {
  SceneRun run = SceneRun::from_text(
      column(cells, "(300 + 100*x) K",
             "law: exponential, reference_viscosity: 1 mPa*s, reference_temperature: 300 K, decay: 0.02 1/K"));
  run.run();
  // dp/dx = −1e7 mu, mu = 1e-3 exp(−2 x).
  const auto exact = [](double x) { return 1e4 / 2 * (std::exp(-2 * x) - std::exp(-2.0)); };
  double worst = 0;
  for (int c = 0; c < run.mesh().cell_count(); ++c)
    worst = std::max(worst, std::abs(run.field("pore.pressure")[c] - exact(run.mesh().cell_center[c][0])));
  for (int i = 0; i < run.mesh().fracture_cell_count(); ++i)
    worst = std::max(worst, std::abs(run.field("conduit.pressure")[i] - exact(run.mesh().fracture_cells[i].center[0])));
  return worst / exact(0);
}

/// Reference: the integral of the viscosity along the column. The viscosity of a cell is that at its centre: with
/// mu' = 2 mu at most, half a cell misses h^2/8 mu', and all cells h^2/24 of the change of mu', together 0.75 h^2 of
/// the largest pressure.
TEST(ThermalViscosity, PressureFollowsItsIntegral) {
  const double coarse = pressure_error(20), fine = pressure_error(40);
  std::printf("errors %.2e, %.2e, order %.2f\n", coarse, fine, std::log2(coarse / fine));
  EXPECT_GT(std::log2(coarse / fine), 1.9);
  EXPECT_LT(fine, 0.75 / (40 * 40));
}

/// Reference: IAPWS, viscosity of water at 0.1 MPa and, at 423 K, at the pressure of saturation; the law is said to be
/// within 2.5 %.
TEST(ThermalViscosity, WaterIsThatOfTheTables) {
  for (const auto& [temperature, viscosity] :
       {std::pair{293.15, 1.0016e-3}, {323.15, 0.5465e-3}, {353.15, 0.3540e-3}, {423.15, 0.1825e-3}}) {
    SceneRun run = SceneRun::from_text(column(10, fmt::format("{} K", temperature), "law: water"));
    run.run();
    const Mesh& mesh = run.mesh();
    EXPECT_NEAR(run.field("pore.pressure")[0] / ((1 - mesh.cell_center[0][0]) * 1e7 * viscosity), 1, 0.025);
    EXPECT_NEAR(run.field("conduit.pressure")[0] / ((1 - mesh.fracture_cells[0].center[0]) * 1e7 * viscosity), 1,
                0.025);
  }
}

TEST(ThermalViscosity, TemperaturesThatAreNotAbsoluteAreRefused) {
  try {
    SceneRun::from_text(column(10, "20 K", "law: water")).run();
    FAIL();
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find("where water is no liquid"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace sprekk::testing
