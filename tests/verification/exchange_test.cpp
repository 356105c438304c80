// Flow between fractures and rock in schemes and limits that are easily got wrong.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

/// A fracture under pressure in a drained block, whose walls are nearly sealed.
std::string block(const std::string& schedule, const std::string& conduit,
                  const std::string& permeability = "1e-13 m^2") {
  return "{geometry: {box: {x: [0 m, 4 m], y: [0 m, 4 m]}, fractures: {f: {points: [[1 m, 2 m], [3 m, 2 m]]}}}, mesh: "
         "{size: 0.5 m, fracture_size: 0.25 m}, components: {pore: {type: matrix_flow/mpfa, porosity: 0.05, "
         "fluid_compressibility: 4.5e-8 1/Pa, permeability: " +
         permeability +
         ", viscosity: 1 mPa*s, initial_pressure: 0.5 MPa, boundary: {left: {pressure: 0.5 MPa}}}, conduit: {type: "
         "fracture_flow/tpfa, viscosity: 1 mPa*s, initial_aperture: 0.2 mm, " +
         conduit + "}}, couplers: [{type: wall_exchange, between: [pore, conduit]}], schedule: " + schedule +
         ", time: {end: 20 s, step: 1 s}}";
}

const std::string leaking =
    "fluid_compressibility: 1e-5 1/Pa, initial_pressure: 1 MPa, normal_permeability: constant, "
    "normal_permeability_value: 1e-12 m/(Pa*s)";

TEST(Exchange, EverySplitCountsTheFluidOnce) {
  for (const char* schedule :
       {"[{solve: [pore, conduit]}]", "[{solve: pore}, {solve: conduit}]", "[{solve: conduit}, {solve: pore}]",
        "[{subcycle: {count: 4, steps: [{solve: pore}]}}, {solve: conduit}]"}) {
    SceneRun run = SceneRun::from_text(block(schedule, leaking));
    run.run();
    EXPECT_GT(run.quantity("fluid_outflow"), 0);
    EXPECT_LE(std::abs(run.quantity("fluid_balance_error")), 1e-11 * run.quantity("fluid_outflow")) << schedule;
  }
}

TEST(Exchange, FractureWithoutPressureDrainsTheRock) {
  // The trace of the pressure at the walls is a small difference of large numbers there.
  SceneRun run =
      SceneRun::from_text(block("[{solve: [pore, conduit]}]",
                                "fluid_compressibility: 1e-9 1/Pa, prescribed: {all: {pressure: 0 Pa}}", "1e-15 m^2"));
  run.run();
  EXPECT_EQ(run.field("conduit.pressure").lpNorm<Eigen::Infinity>(), 0);
  EXPECT_LT(run.field("pore.wall_flux").maxCoeff(), 0);
  EXPECT_GT(run.field("pore.pressure").minCoeff(), 0);
}

TEST(Exchange, PrescribedPressureDoesNotHideWhatIsInjectedBeside) {
  // An incompressible fluid between a prescribed pressure and an injection: Darcy's law gives the drop over the
  // distance.
  SceneRun run = SceneRun::from_text(block("[{solve: [pore, conduit]}]",
                                           "fluid_compressibility: 0 1/Pa, prescribed: {end: {at: [1.1 m, 2 m], "
                                           "pressure: 1 MPa}}, injection: {well: {at: [2.9 m, 2 "
                                           "m], rate: {value: 1e-6 m^2/s, from: 2 s}}}, normal_permeability: constant, "
                                           "normal_permeability_value: 0 m/(Pa*s)"));
  run.run();
  const Mesh& mesh = run.mesh();
  const int first = mesh.fractures[0].first_cell, last = first + mesh.fractures[0].cell_count - 1;
  const double distance = (mesh.fracture_cells[last].center - mesh.fracture_cells[first].center).norm();
  const double drop = 1e-6 * 1e-3 * 12 / std::pow(0.2e-3, 3) * distance;
  EXPECT_NEAR(run.field("conduit.pressure")[first], 1e6, 1e-6);
  EXPECT_NEAR((run.field("conduit.pressure")[last] - 1e6) / drop, 1, 1e-9);
}

}  // namespace
}  // namespace sprekk::testing
