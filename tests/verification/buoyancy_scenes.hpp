// Scenes of a fluid that heat makes lighter: a closed box with fractures, and a square between a hot and a cold side.
#pragma once

#include <fmt/format.h>

#include <string>

#include "framework/types.hpp"

namespace sprekk::testing {

/// A closed box of rock with fractures, insulated but for the temperature of its sides, which is linear along gravity;
/// `flow` and the mesh vary.
inline std::string closed(const std::string& flow, const std::string& mesh, const Point& gravity) {
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

inline std::string squares(int cells) {
  return fmt::format("{{kind: structured, cells: [{0}, {0}], shape: quadrilaterals}}", cells);
}

}  // namespace sprekk::testing
