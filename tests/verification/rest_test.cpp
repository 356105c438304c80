// A state at rest stays at rest, and every cell balances.
#include <gtest/gtest.h>

#include <cmath>

#include "components/matrix_flow/matrix_flow.hpp"
#include "components/poromechanics/rock.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

// Hydrostatic water, lithostatic rock with a horizontal stress of 0.7 times the vertical one, and a fracture that
// sticks.
const char* const at_rest =
    "{geometry: {box: {x: [0 m, 10 m], y: [0 m, 10 m]}, fractures: {crack: {points: [[4 m, 4 m], [6 m, 6 m]]}}}, mesh: "
    "{size: 1 m, fracture_size: 0.4 m}, materials: {young_modulus: 10 GPa, poisson_ratio: 0.25, biot_coefficient: 0.9, "
    "porosity: 0.1, fluid_compressibility: 4e-10 1/Pa, permeability: {along: 1e-14 m^2, across: 1e-16 m^2, angle: 20 "
    "deg}, "
    "viscosity: 1 mPa*s, friction: 0.8, gravity: [0 m/s^2, -9.81 m/s^2], fluid_density: 1000 kg/m^3, rock_density: "
    "2500 "
    "kg/m^3}, components: {pore: {type: matrix_flow/mpfa, initial_pressure: '(9810*(10 - y)) Pa', boundary: {top: "
    "{pressure: 0 Pa}}}, rock: {type: poromechanics/mpsa, initial_stress: {xx: '(-0.7*24525*(10 - y)) Pa', yy: "
    "'(-24525*(10 - y)) Pa', xy: 0 Pa}, boundary: {left: {displacement_x: 0 m}, right: {displacement_x: 0 m}, bottom: "
    "{displacement_y: 0 m}}}, conduit: {type: fracture_flow/tpfa, initial_aperture: 0.1 mm, initial_pressure: "
    "'(9810*(10 - "
    "y)) Pa'}, contact: {type: contact/coulomb}}, couplers: [{type: biot, between: [pore, rock]}, {type: "
    "wall_exchange, "
    "between: [pore, conduit]}, {type: wall_traction, between: [rock, contact, conduit]}, {type: aperture, between: "
    "[contact, conduit]}], schedule: [{solve: [pore, rock, conduit, contact]}], time: {end: 5 h, step: 1 h}}";

TEST(Rest, GravityAndInitialStressAreInBalanceToRoundOff) {
  SceneRun run = SceneRun::from_text(at_rest);
  run.run();
  // Without the initial stress the weight alone would move the rock by 1e-4 m, and the pressure goes up to 1e5 Pa.
  EXPECT_LT(run.field("rock.displacement").lpNorm<Eigen::Infinity>(), 1e-14);
  for (int c = 0; c < run.mesh().cell_count(); ++c)
    EXPECT_NEAR(run.field("pore.pressure")[c], 9810 * (10 - run.mesh().cell_center[c][1]), 1e-5);
  for (int i = 0; i < run.mesh().fracture_cell_count(); ++i) {
    const FractureCell& cell = run.mesh().fracture_cells[i];
    const double depth = 10 - cell.center[1];
    EXPECT_NEAR(run.field("conduit.pressure")[i], 9810 * depth, 1e-5);
    const double normal = -24525 * depth * (0.7 * cell.normal[0] * cell.normal[0] + cell.normal[1] * cell.normal[1]);
    EXPECT_NEAR(run.field("contact.traction")[2 * i], normal + 9810 * depth, 1e-3);
  }
}

TEST(Balance, EveryCellBalancesFluidAndForces) {
  // From the fluxes and forces on faces themselves, which each cell shares with its neighbours.
  SceneRun run("paper/onset_coarse.yaml", {{"mesh.size", "0.25 m"}, {"mesh.fracture_size", "0.01 m"}});
  run.run_until(7 * 3600);
  const Mesh& mesh = run.mesh();
  const StepTime step{7 * 3600, 3600, 8 * 3600};
  const Vector balance_before = run.field("pore.cumulative_balance");
  const Vector volume_before = run.field("biot.fluid_stored");
  ASSERT_TRUE(run.model().attempt(step).converged);
  const matrix_flow::MatrixFlow* flow = nullptr;
  const poromechanics::Rock* rock = nullptr;
  for (const auto& component : run.model().components()) {
    if (auto* found = dynamic_cast<matrix_flow::MatrixFlow*>(component.get())) flow = found;
    if (auto* found = dynamic_cast<poromechanics::Rock*>(component.get())) rock = found;
  }
  ASSERT_TRUE(flow && rock);
  const Vector fluxes = flow->face_fluxes(), forces = rock->face_forces();
  const double largest_flux = step.dt * fluxes.lpNorm<Eigen::Infinity>();
  const double largest_force = forces.lpNorm<Eigen::Infinity>();
  for (int c = 0; c < mesh.cell_count(); ++c) {
    double fluid = run.field("pore.cumulative_balance")[3 * c] - balance_before[3 * c] +
                   run.field("biot.fluid_stored")[c] - volume_before[c];
    Point force = Point::Zero();
    for (const int face : mesh.cell_faces[c]) {
      const double sign = mesh.face_cells[face][0] == c ? 1 : -1;
      fluid += step.dt * sign * fluxes[face];
      force += sign * forces.segment<2>(2 * face);
    }
    EXPECT_LE(std::abs(fluid), 1e-9 * largest_flux) << c;
    EXPECT_LE(force.norm(), 1e-9 * largest_force) << c;
  }
}

/// The difference of cells from the mean of their neighbours (root mean square), over the range of the pressure. It
/// falls with the mesh size for a smooth pressure, and not for one that alternates from cell to cell.
double roughness(const SceneRun& run) {
  const Mesh& mesh = run.mesh();
  const Vector& p = run.field("pore.pressure");
  double squares = 0;
  int count = 0;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    double mean = 0;
    int neighbours = 0;
    for (const int face : mesh.cell_faces[c]) {
      const int other = mesh.face_cells[face][0] == c ? mesh.face_cells[face][1] : mesh.face_cells[face][0];
      if (other == none) continue;
      mean += p[other];
      ++neighbours;
    }
    if (neighbours < 3) continue;
    squares += std::pow(p[c] - mean / neighbours, 2);
    ++count;
  }
  return std::sqrt(squares / count) / (p.maxCoeff() - p.minCoeff());
}

TEST(Stability, CantileverBracketHasNoAlternatingPressure) {
  const auto bracket = [](const char* size) {
    return std::string("{geometry: {box: {x: [0 m, 1 m], y: [0 m, 1 m]}}, mesh: {size: ") + size +
           "}, components: {pore: {type: matrix_flow/mpfa, permeability: 1e-7 m^2, viscosity: 1 Pa*s, storage: 0 "
           "1/Pa}, "
           "rock: {type: poromechanics/mpsa, young_modulus: 1e5 Pa, poisson_ratio: 0.4, boundary: {left: "
           "{displacement: [0 "
           "m, 0 m]}, top: {traction: [0 Pa, -1 Pa]}}}}, couplers: [{type: biot, between: [pore, rock], "
           "biot_coefficient: "
           "0.93}], schedule: [{solve: [pore, rock]}], time: {end: 5e-3 s, step: 1e-3 s}}";
  };
  SceneRun coarse = SceneRun::from_text(bracket("0.0625 m")), fine = SceneRun::from_text(bracket("0.03125 m"));
  coarse.run();
  fine.run();
  EXPECT_LT(roughness(fine), 5e-3);
  EXPECT_GT(roughness(coarse) / roughness(fine), 1.8);
}

TEST(Stability, LayersOfLittleMobilityDoNotOscillate) {
  // A column with mobility 1 / 1e-8 / 1, loaded and drained at its lower end: nothing leaves the two layers behind the
  // seal, so that the undrained pressure 1 stays there, and below it falls towards the drain.
  SceneRun run("verification/terzaghi.yaml",
               {{"geometry.regions", "{seal: {polygon: [[0, 0.4], [0.1, 0.4], [0.1, 0.6], [0, 0.6]]}}"},
                {"components.pore.permeability", "{regions: {rock: 1 m^2, seal: 1e-8 m^2}}"}});
  run.run();
  for (int c = 0; c < run.mesh().cell_count(); ++c) {
    const double y = run.mesh().cell_center[c][1], p = run.field("pore.pressure")[c];
    EXPECT_GT(p, -1e-10);
    EXPECT_LT(p, 1 + 1e-3) << y;
    if (y > 0.45) {
      EXPECT_NEAR(p, 1, 1e-3) << y;
    }
  }
}

}  // namespace
}  // namespace sprekk::testing
