// The weight of a fluid that follows temperature and pressure: derivatives, fluid at rest, columns, laws, mistakes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "components/capabilities/fluid_fluxes.hpp"
#include "framework/config/input_error.hpp"
#include "tests/verification/buoyancy_scenes.hpp"
#include "tests/verification/derivatives.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

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
  pore: {{type: {}, storage: 0.7 1/Pa, boundary: {{left: {{pressure: "(1 + y) Pa"}}, right: {{pressure: 1 Pa}}, top: {{flux: 0.1 m/s}}}}}}
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
