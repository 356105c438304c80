// What is injected is stored or flows out, however well the rock conducts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "framework/config/yaml/load_scene.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

/// The largest error of the cumulative balance after any step, over the largest figure in it.
double error_of_balance(SceneRun& run) {
  double error = 0, throughput = 0;
  run.run_until(run.model().scene().time.end, [&] {
    error = std::max(error, std::abs(run.quantity("fluid_balance_error")));
    for (const char* figure : {"fluid_stored", "fluid_injected", "fluid_outflow"})
      throughput = std::max(throughput, std::abs(run.quantity(figure)));
  });
  EXPECT_GT(throughput, 0);
  return error / throughput;
}

/// The tutorial's scene, whose left side is open: rock, fluid, friction and a fracture that opens.
std::vector<Override> scene(const std::string& permeability) {
  return {{"materials.permeability", permeability},
          {"mesh.size", "1.5 m"},
          {"mesh.fracture_size", "0.4 m"},
          {"time.end", "4 h"}};
}

// A pressure of 5 MPa has the round-off of itself, which drives a flow: of k/mu dt p in a step of an hour. Beside 0.07
// m^2 that flow out this counts from 1e-6 m^2 on.
TEST(CumulativeBalance, CloseWithAnOpenSide) {
  for (const double permeability : {1e-24, 1e-17, 1e-10, 1e-6, 1e-3}) {
    SCOPED_TRACE(permeability);
    SceneRun run("tutorial/first_scene.yaml", scene(std::to_string(permeability * 1e24) + "e-24 m^2"));
    const double round_off = 64 * 2.2e-16 * permeability / 1e-3 * 3600 * 5e6 / 0.07;
    EXPECT_LT(error_of_balance(run), 1e-7 + round_off);
  }
}

std::string closed_scene(const std::string& permeability) {
  return R"(
name: closed
geometry:
  box: {x: [0 m, 2 m], y: [0 m, 2 m]}
  fractures:
    main: {center: [1 m, 1 m], length: 0.4 m, angle: 30 deg}
mesh: {size: 0.5 m, fracture_size: 0.1 m, growth: 0.6}
materials: {young_modulus: 40 GPa, poisson_ratio: 0.2, biot_coefficient: 0.8, porosity: 0.01,
            fluid_compressibility: 4.0e-10 1/Pa, viscosity: 1.0e-4 Pa*s, friction: 0.5, permeability: )" +
         permeability + R"(}
components:
  pore: {type: matrix_flow/mpfa}
  rock:
    type: poromechanics/mpsa
    boundary: {left: {displacement_x: 0 m}, bottom: {displacement_y: 0 m}}
  conduit:
    type: fracture_flow/tpfa
    initial_aperture: 1 mm
    injection: {well: {fracture: main, rate: 2.0e-8 m^2/s}}
  contact: {type: contact/coulomb}
couplers:
  - {type: biot, between: [pore, rock]}
  - {type: wall_exchange, between: [pore, conduit]}
  - {type: wall_traction, between: [rock, contact, conduit]}
  - {type: aperture, between: [contact, conduit]}
schedule:
  - solve: [pore, rock, conduit, contact]
time: {end: 80 s, step: 20 s}
)";
}

// The constant mode of the pressure is determined by what rock and fluid store, as little as 1e-15 of what the rock
// conducts in a step.
TEST(CumulativeBalance, CloseInAClosedBlock) {
  for (const char* permeability : {"1e-24 m^2", "5e-20 m^2", "1e-10 m^2", "1e-6 m^2", "1e-3 m^2"}) {
    SCOPED_TRACE(permeability);
    SceneRun run = SceneRun::from_text(closed_scene(permeability));
    EXPECT_LT(error_of_balance(run), 1e-7);
  }
}

// Flow and rock in turn: the same test ends the iteration.
TEST(CumulativeBalance, CloseWhereASchemeIterates) {
  for (const char* permeability : {"1e-17 m^2", "1e-10 m^2"}) {
    SCOPED_TRACE(permeability);
    std::vector<Override> changes = scene(permeability);
    changes.push_back({"schedule",
                       "[{iterate: {fallback: none, steps: [{solve: [pore, conduit], stabilize: fixed_stress}, "
                       "{solve: [rock, contact]}]}}]"});
    SceneRun run("tutorial/first_scene.yaml", changes);
    EXPECT_LT(error_of_balance(run), 1e-5);
  }
}

}  // namespace
}  // namespace sprekk::testing
