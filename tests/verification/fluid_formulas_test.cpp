// Density and viscosity as formulas of temperature and pressure: built-in laws written as formulas have their answers.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

using ::testing::HasSubstr;

/// Warm fluid below cold one in a box with gravity, and a fracture in it.
std::string scene(const std::string& viscosity, const std::string& density) {
  return fmt::format(R"yaml(
geometry: {{box: {{x: [0 m, 10 m], y: [0 m, 8 m]}}, fractures: {{crack: {{points: [[2 m, 2 m], [7 m, 6 m]]}}}}}}
mesh: {{size: 2 m}}
materials: {{gravity: [0 m/s^2, -9.81 m/s^2], viscosity: 1 mPa*s, fluid_compressibility: 4e-10 1/Pa}}
components:
  pore: {{type: matrix_flow/mpfa, permeability: 1e-12 m^2, storage: 1e-10 1/Pa, initial_pressure: "(1e5 + 9810*(8 - y)) Pa"}}
  conduit: {{type: fracture_flow/tpfa, initial_aperture: 0.3 mm, initial_pressure: "(1e5 + 9810*(8 - y)) Pa"}}
  heat: {{type: matrix_heat/mpfa, conductivity: 2 W/(m*K), heat_capacity: 2e6 J/(m^3*K), initial_temperature: "(350 - 6*y + 2*x) K"}}
  water: {{type: fracture_heat/tpfa, aperture: 0.3 mm, conductivity: 0.6 W/(m*K), heat_capacity: 4e6 J/(m^3*K), initial_temperature: "(350 - 6*y + 2*x) K"}}
couplers:
  - {{type: wall_exchange, between: [pore, conduit]}}
  - {{type: heat_exchange, between: [heat, water]}}
  - {{type: heat_advection, between: [pore, conduit, heat, water], fluid_heat_capacity: 4.2e6 J/(m^3*K)}}
  - {{type: thermal_viscosity, between: [pore, conduit, heat, water], {}}}
  - {{type: buoyancy, between: [pore, conduit, heat, water], {}}}
schedule: [{{solve: [pore, conduit, heat, water]}}]
time: {{end: 2 day, step: 1 day}}
)yaml",
                     viscosity, density);
}

TEST(FluidFormulas, OfBuiltInLawsHaveTheirAnswers) {
  SceneRun known = SceneRun::from_text(
      scene("law: exponential, reference_viscosity: 1 mPa*s, reference_temperature: 300 K, decay: 0.02 1/K",
            "law: exponential, fluid_density: 990 kg/m^3, fluid_expansion: 4e-4 1/K, reference_temperature: 300 K, "
            "compressibility: 4e-10 1/Pa, reference_pressure: 1e5 Pa"));
  SceneRun run = SceneRun::from_text(
      scene("law: formula, viscosity: \"1 mPa*s*exp(-0.02 1/K*(T - 300 K))\"",
            "law: formula, density: \"990 kg/m^3*exp(-4e-4 1/K*(T - 300 K) + 4e-10 1/Pa*(p - 1e5 Pa))\""));
  for (int step = 0; step < 2; ++step) {
    ASSERT_TRUE(known.step() && run.step());
    EXPECT_EQ(run.iterations(), known.iterations());
  }
  for (const char* field : {"pore.pressure", "conduit.pressure", "heat.temperature", "water.temperature"}) {
    const Vector difference = run.field(field) - known.field(field);
    EXPECT_LT(difference.lpNorm<Eigen::Infinity>(), 1e-11 * known.field(field).lpNorm<Eigen::Infinity>()) << field;
  }
}

TEST(FluidFormulas, RefuseWhatHasNoMeaning) {
  const auto refused = [](const std::string& viscosity, const std::string& density) {
    try {
      SceneRun::from_text(scene(viscosity, density));
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string water = "law: water";
  EXPECT_THAT(refused("law: formula", water), HasSubstr("'viscosity' is missing"));
  EXPECT_THAT(refused("law: water, viscosity: \"1 mPa*s*T/(300 K)\"", water), HasSubstr("'viscosity' has no effect"));
  EXPECT_THAT(refused("law: formula, viscosity: \"1 mPa*s*T\"", water), HasSubstr("has another unit"));
  EXPECT_THAT(refused("law: formula, viscosity: \"1 mPa*s*(x/m + T/(300 K))\"", water),
              HasSubstr("'viscosity' depends on place or time"));
  EXPECT_THAT(refused(water, "law: formula"), HasSubstr("'density' is missing"));
  EXPECT_THAT(refused(water, "law: formula, density: 990 kg/m^3"), HasSubstr("the density does not vary"));
  EXPECT_THAT(refused(water, "law: formula, density: \"990 kg/m^3*(300 K/T)\", compressibility: 1e-10 1/Pa"),
              HasSubstr("parameters of other laws have no effect"));
}

}  // namespace
}  // namespace sprekk::testing
