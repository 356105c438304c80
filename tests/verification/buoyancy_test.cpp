// The weight of a fluid that follows temperature and pressure: derivatives, rest, the onset of convection, convection.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "components/capabilities/fluid_fluxes.hpp"
#include "framework/config/input_error.hpp"
#include "tests/verification/derivatives.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

constexpr double pi = std::numbers::pi;

/// All derivatives by temperatures and pressures, against differences: fractures cross, touch and end in the rock and on
/// sides, with and without a temperature there.
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
  const std::string rock = "heat.temperature", water = "water.temperature", p = "pore.pressure", h = "pore.face_pressure",
                    lambda = "pore.wall_flux", pi_ = "conduit.pressure", q = "conduit.flux";
  for (const std::string flow : {"matrix_flow/mpfa", "matrix_flow/tpfa", "matrix_flow/rt0", "matrix_flow/ntpfa"})
    for (const std::string law :
         {"law: exponential, fluid_expansion: 0.3 1/K, reference_temperature: 1 K, compressibility: 0.2 1/Pa",
          "law: linear, fluid_expansion: 0.1 1/K, reference_temperature: 1 K"}) {
      SCOPED_TRACE(flow + ", " + law);
      SceneRun run = SceneRun::from_text(small(flow, "matrix_heat/mpfa", law));
      std::vector<Spread> spreads = {{p, -1, 1}, {lambda, -1, 1}, {pi_, -1, 1}, {q, -1, 1}, {rock, 1, 2}, {water, 1, 2}};
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
}  // namespace
}  // namespace sprekk::testing
