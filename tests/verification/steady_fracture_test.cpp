// Steady flow along a fracture: what flows in flows out, and nothing else is left in the balance of a cell.
#include <gtest/gtest.h>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

std::string scene(const std::string& aperture, bool with_rock) {
  return std::string(R"(
geometry:
  box: {x: [0 m, 10 m], y: [0 m, 4 m]}
  fractures: {f: {points: [[0 m, 2 m], [10 m, 2 m]]}}
mesh: {size: 0.5 m, fracture_size: 0.25 m}
materials: {fluid_compressibility: 4e-10 1/Pa, viscosity: 1 mPa*s, porosity: 0.1, permeability: 1e-18 m^2}
components:
  conduit:
    type: fracture_flow/tpfa
    initial_aperture: )") +
         aperture + R"(
    boundary: {left: {pressure: 2 MPa}, right: {pressure: 1 MPa}}
)" +
         (with_rock ? R"(
  pore:
    type: matrix_flow/mpfa
    boundary: {left: {pressure: "((2 - x/(10))*1e6) Pa"}, right: {pressure: 1 MPa}}
couplers: [{type: wall_exchange, between: [pore, conduit]}]
schedule: [{solve: [pore, conduit]}]
)"
                    : R"(
schedule: [{solve: conduit}]
)") + "time: {end: 1000 day, step: 100 day}\n";
}

/// Reference: pressure is linear along the fracture, and stays so. Before, the balance of a cell was compared with its
/// round-off only, and steps were cut without end.
TEST(SteadyFracture, HasALinearPressureAfterEveryWholeStep) {
  for (const char* aperture : {"0.01 mm", "0.1 mm", "1 mm"})
    for (const bool with_rock : {false, true}) {
      SceneRun run = SceneRun::from_text(scene(aperture, with_rock));
      run.run();
      EXPECT_EQ(run.steps(), 10) << aperture;
      const Vector& pressure = run.field("conduit.pressure");
      for (int i = 0; i < pressure.size(); ++i)
        EXPECT_NEAR(pressure[i], 2e6 - 1e5 * run.mesh().fracture_cells[i].center[0], 1e-9 * 2e6) << aperture;
    }
}

}  // namespace
}  // namespace sprekk::testing
