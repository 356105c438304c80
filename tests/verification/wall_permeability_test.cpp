// Fractures whose walls have different normal permeabilities, against flow through layers in series.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "framework/mesh/build_mesh.hpp"
#include "tests/verification/mesh_file.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

/// Layers of 0.4 m and 0.6 m on the left and on the right of a fracture that goes up through a box of 1 m, between the
/// pressures 1 and 0; `walls`: the permeabilities of the fracture's walls.
SceneRun layers(const std::string& flow, const std::string& walls, double degrees, const std::string& points) {
  SceneRun drawn = SceneRun::from_text(
      "{geometry: {box: {x: [0 m, 1 m], y: [0 m, 1 m]}, fractures: {seal: {points: " + points +
      "}}}, mesh: {size: 0.2 m}, components: {pore: {type: matrix_flow/mpfa, permeability: 1 m^2, viscosity: 1 Pa*s, "
      "storage: 1 1/Pa}}, schedule: [{solve: pore}], time: {end: 1 s, step: 1 s}}");
  const std::string mesh =
      write_msh(to_raw_mesh(drawn.mesh()), turned_by(degrees), Point(0.2, -0.1), "wall_permeability");
  return SceneRun::from_text(fmt::format(
      "{{geometry: {{file: {}}}, components: {{pore: {{type: matrix_flow/{}, permeability: 2 m^2, viscosity: 1 Pa*s, "
      "storage: 0 1/Pa, boundary: {{left: {{pressure: 1 Pa}}, right: {{pressure: 0 Pa}}}}}}, conduit: {{type: "
      "fracture_flow/tpfa, viscosity: 1 Pa*s, fluid_compressibility: 0 1/Pa, initial_aperture: 0.1 m, {}}}}}, "
      "couplers: [{{type: wall_exchange, between: [pore, conduit]}}], schedule: [{{solve: [pore, conduit]}}], time: "
      "{{end: 2e9 s, step: 1e9 s}}}}",
      mesh, flow, walls));
}

/// Left and right of the fracture as it goes from its first to its last point, m/(Pa s).
void expect_in_series(const std::string& flow, const std::string& walls, double left, double right, double degrees,
                      bool goes_up) {
  SceneRun run =
      layers(flow, walls, degrees, goes_up ? "[[0.4 m, 0 m], [0.4 m, 1 m]]" : "[[0.4 m, 1 m], [0.4 m, 0 m]]");
  run.run();
  if (!goes_up) std::swap(left, right);
  const double flux = 1 / (0.4 / 2 + 1 / left + 1 / right + 0.6 / 2);
  const double pressure = 1 - flux * (0.4 / 2 + 1 / left);
  for (const double p : run.field("conduit.pressure"))
    EXPECT_NEAR(p, pressure, 1e-9) << flow << walls << degrees << goes_up;
  for (int w = 0; w < run.mesh().wall_count(); ++w)
    EXPECT_NEAR(std::abs(run.field("pore.wall_flux")[w]), flux, 1e-9 * flux) << flow << walls << degrees << goes_up;
}

TEST(WallPermeability, LayersInSeriesAreExact) {
  for (const std::string flow : {"mpfa", "rt0"})
    for (const double degrees : {0.0, 30.0})
      for (const bool goes_up : {true, false}) {
        expect_in_series(flow, "wall_permeability: {left: 3 m/(Pa*s), right: 0.2 m/(Pa*s)}", 3, 0.2, degrees, goes_up);
        expect_in_series(flow, "wall_permeability: {left: 1e-6 m/(Pa*s), right: 1e6 m/(Pa*s)}", 1e-6, 1e6, degrees,
                         goes_up);
        expect_in_series(
            flow,
            "wall_permeability: {right: 5 m/(Pa*s)}, normal_permeability: constant, normal_permeability_value: 0.7 "
            "m/(Pa*s)",
            0.7, 5, degrees, goes_up);
        // a/(6 mu) of the cubic law
        expect_in_series(flow, "wall_permeability: {left: 2 m/(Pa*s)}", 2, 0.1 / 6, degrees, goes_up);
      }
}

TEST(WallPermeability, ASealedWallLetsNothingThrough) {
  for (const char* side : {"left", "right"}) {
    SceneRun run =
        layers("mpfa", fmt::format("wall_permeability: {{{}: 0 m/(Pa*s)}}", side), 30, "[[0.4 m, 0 m], [0.4 m, 1 m]]");
    run.run();
    // The fracture has the pressure of its other side.
    for (const double p : run.field("conduit.pressure")) EXPECT_NEAR(p, side[0] == 'l' ? 0 : 1, 1e-6);
    EXPECT_LT(run.field("pore.wall_flux").lpNorm<Eigen::Infinity>(), 1e-6);
  }
}

/// A skin that grows in time, on one wall: each step has its own steady state.
TEST(WallPermeability, FollowsTimeAndPlace) {
  SceneRun run = layers("mpfa", "wall_permeability: {left: (0.5 + t/4e9) m/(Pa*s), right: 4 m/(Pa*s)}", 0,
                        "[[0.4 m, 0 m], [0.4 m, 1 m]]");
  run.run();
  const double flux = 1 / (0.4 / 2 + 1 / 1.0 + 1 / 4.0 + 0.6 / 2);
  for (int w = 0; w < run.mesh().wall_count(); ++w)
    EXPECT_NEAR(std::abs(run.field("pore.wall_flux")[w]), flux, 1e-9 * flux);
}

}  // namespace
}  // namespace sprekk::testing
