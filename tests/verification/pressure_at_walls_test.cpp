// What the flow in rock tells of its pressure at the walls of fractures, for changes of the mesh.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "framework/assembly/follows_mesh.hpp"
#include "framework/field/known_within_cells.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

/// Fluid at rest under gravity, with a fracture: its pressure is that of its column, at walls, too.
TEST(PressureAtWalls, IsThatOfTheColumn) {
  for (const char* type : {"mpfa", "tpfa", "ntpfa", "rt0"})
    for (const Point& gravity : {Point(0, -10), Point(3, -8)}) {
      const std::string pressure = fmt::format("(300 + 1000*({}*x + {}*y)) Pa", gravity.x(), gravity.y());
      SceneRun run = SceneRun::from_text(fmt::format(
          R"(
geometry: {{box: {{x: [0 m, 1 m], y: [0 m, 1 m]}}, fractures: {{f: {{points: [[0.3, 0.2], [0.55, 0.4], [0.7, 0.8]]}}}}}}
mesh: {{size: 0.2 m, fracture_size: 0.1 m}}
components:
  pore: {{type: matrix_flow/{}, permeability: 1e-15 m^2, viscosity: 1 mPa*s, storage: 0 1/Pa,
    gravity: [{} m/s^2, {} m/s^2], fluid_density: 1000 kg/m^3,
    boundary: {{left: {{pressure: "{}"}}, right: {{pressure: "{}"}}, bottom: {{pressure: "{}"}}, top: {{pressure: "{}"}}}}}}
  conduit: {{type: fracture_flow/tpfa, viscosity: 1 mPa*s, initial_aperture: 1 mm, fluid_compressibility: 0 1/Pa,
    gravity: [{} m/s^2, {} m/s^2], fluid_density: 1000 kg/m^3}}
couplers: [{{type: wall_exchange, between: [pore, conduit]}}]
schedule: [{{solve: [pore, conduit]}}]
time: {{end: 1 s, step: 1 s}}
)",
          type, gravity.x(), gravity.y(), pressure, pressure, pressure, pressure, gravity.x(), gravity.y()));
      run.run();
      const Mesh& mesh = run.mesh();
      KnownWithinCells known;
      for (const auto* part : parts_with<FollowsMesh>(run.model().parts())) {
        part->add_known_within_cells(run.model().fields().at("conduit.pressure"), known);
        EXPECT_TRUE(known.at_faces.empty());
        part->add_known_within_cells(run.model().fields().at("pore.pressure"), known);
        if (!known.at_faces.empty()) break;
      }
      EXPECT_EQ(static_cast<int>(known.at_faces.size()), mesh.wall_count());
      for (const auto& [face, value] : known.at_faces)
        EXPECT_NEAR(value, 300 + 1000 * gravity.dot(mesh.face_center[face]), 1e-3) << type << ' ' << face;
    }
}

}  // namespace
}  // namespace sprekk::testing
