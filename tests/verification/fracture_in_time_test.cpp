// Contact and flow in fractures whose properties change with time.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "framework/assembly/counts_work.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

/// A square in units with lambda = G = 1, cut by a fracture at 30 degrees through (0.5, 0.5), t = (cos 30, sin 30), n =
/// (sin 30, -cos 30). Its sides follow a uniform strain, and on the minus side the rigid jump (normal, tangential).
std::string cut_square(const std::string& normal, const std::string& tangential, const std::string& friction,
                       const std::string& dilation) {
  const std::string side = "(0.5*(x-0.5) - 0.8660254037844386*(y-0.5) > 0)";
  const std::string u = "{displacement: [\"-0.02*x + 0.001*y + if(" + side + ", 0.5*(" + normal +
                        ") + 0.8660254037844386*(" + tangential + "), 0)\", \"0.001*x - 0.01*y + if(" + side +
                        ", -0.8660254037844386*(" + normal + ") + 0.5*(" + tangential + "), 0)\"]}";
  return "{geometry: {box: {x: [0, 1], y: [0, 1]}, fractures: {cut: {points: [[0, 0.2113248654051871], [1, "
         "0.7886751345948129]]}}}, mesh: {size: 0.12, distortion: 0.2}, components: {rock: {type: poromechanics/mpsa, "
         "young_modulus: 2.5 Pa, poisson_ratio: 0.25, boundary: {left: " +
         u + ", right: " + u + ", bottom: " + u + ", top: " + u + "}}, contact: {type: contact/coulomb, friction: \"" +
         friction + "\", dilation_angle: \"" + dilation +
         "\"}}, couplers: [{type: wall_traction, between: [rock, contact]}], schedule: [{solve: [rock, contact]}], "
         "time: "
         "{end: 4 s, step: 1 s}}";
}

/// n·sigma on the fracture for the uniform strain: sigma = 2 eps + tr(eps) I.
Point uniform_traction() {
  Tensor stress;
  stress << -0.07, 0.002, 0.002, -0.05;
  const Point n(0.5, -std::sqrt(3) / 2), t(std::sqrt(3) / 2, 0.5);
  return {(stress * n).dot(n), (stress * n).dot(t)};
}

double largest_slip(const SceneRun& run) {
  double largest = 0;
  for (int i = 0; i < run.mesh().fracture_cell_count(); ++i)
    largest = std::max(largest, std::abs(run.field("contact.jump")[2 * i + 1]));
  return largest;
}

/// mu falls through the ratio of the tractions between the second step and the third.
TEST(ContactInTime, SlipsWhereFrictionFallsBelowTheLoad) {
  const double ratio = std::abs(uniform_traction()[1] / uniform_traction()[0]);
  for (const double fall : {0.1, 1e-6}) {
    SceneRun run =
        SceneRun::from_text(cut_square("0", "0", fmt::format("{:.17g}*(1 + {:.17g}*(2.5 - t))", ratio, fall), "0"));
    run.run_until(4, [&] {
      const double friction = ratio * (1 + fall * (2.5 - run.time()));
      if (run.time() < 2.5) {
        EXPECT_LT(largest_slip(run), 1e-14) << run.time();
        EXPECT_EQ(run.quantity("contact.cells_stick"), run.mesh().fracture_cell_count());
        return;
      }
      EXPECT_GT(largest_slip(run), 1e-4 * fall) << run.time();
      const Vector& traction = run.field("contact.traction");
      for (int i = 0; i < run.mesh().fracture_cell_count(); ++i)
        EXPECT_NEAR(std::abs(traction[2 * i + 1]), -friction * traction[2 * i], 1e-10);
    });
    EXPECT_EQ(parts_with<CountsWork>(run.model().parts()).front()->counts().at("stress discretizations"), 1);
  }
}

/// The sides have slipped by s in the first step, and open as the angle grows: [u]_n = s tan psi(t) everywhere.
TEST(ContactInTime, OpensAsTheAngleOfDilationGrows) {
  const Point traction = uniform_traction();
  const double ratio = std::abs(traction[1] / traction[0]), slip = traction[1] > 0 ? 1e-3 : -1e-3;
  SceneRun run =
      SceneRun::from_text(cut_square("1e-3*tan(0.1 + 0.05*t)", fmt::format("{}", slip),
                                     fmt::format("{:.17g}*(1 + max(0, t - 1))", ratio), "(0.1 + 0.05*t) rad"));
  run.run_until(4, [&] {
    const double opening = 1e-3 * std::tan(0.1 + 0.05 * run.time());
    for (int i = 0; i < run.mesh().fracture_cell_count(); ++i) {
      EXPECT_NEAR(run.field("contact.jump")[2 * i], opening, 1e-12) << run.time();
      EXPECT_NEAR(run.field("contact.jump")[2 * i + 1], slip, 1e-12) << run.time();
      EXPECT_NEAR(run.field("contact.traction")[2 * i], traction[0], 1e-12) << run.time();
    }
  });
}

std::string crossed(const std::string& conduit, const std::string& more) {
  return "{geometry: {box: {x: [0, 2], y: [0, 1]}, fractures: {cut: {points: [[1, 0], [1, 1]]}}}, mesh: {kind: "
         "structured, shape: quadrilaterals, cells: [4, 2]}, components: {conduit: {type: fracture_flow/tpfa, " +
         conduit + "}" + more + ", time: {end: 4 s, step: 1 s}}";
}

/// T/mu times the difference of pressure over the length.
TEST(FractureFlowInTime, FluxFollowsTransmissivityAndViscosity) {
  SceneRun run = SceneRun::from_text(crossed(
      "initial_aperture: 1 mm, transmissivity: constant, transmissivity_value: (1e-12*(1 + t)) m^3, viscosity: "
      "(1e-3*(1 + t/10)) Pa*s, fluid_compressibility: 0 1/Pa, boundary: {bottom: {pressure: 2 Pa}, top: {pressure: 1 "
      "Pa}}",
      "}, schedule: [{solve: conduit}]"));
  run.run_until(4, [&] {
    const double flux = 1e-12 * (1 + run.time()) / (1e-3 * (1 + run.time() / 10));
    for (const double q : run.field("conduit.flux")) EXPECT_NEAR(std::abs(q), flux, 1e-10 * flux) << run.time();
  });
}

/// L a c(t) (p − p_old) = q dt.
TEST(FractureFlowInTime, PressureRisesWithTheCompressibilityOfItsTime) {
  SceneRun run = SceneRun::from_text(
      crossed("initial_aperture: 1 mm, viscosity: 1 mPa*s, fluid_compressibility: (1e-9*(1 + t)) 1/Pa, injection: "
              "{well: {rate: 1e-9 m^2/s}}",
              "}, schedule: [{solve: conduit}]"));
  double pressure = 0;
  run.run_until(4, [&] {
    pressure += 1e-9 / (1e-3 * 1e-9 * (1 + run.time()));
    for (const double p : run.field("conduit.pressure")) EXPECT_NEAR(p, pressure, 1e-9 * pressure) << run.time();
    EXPECT_NEAR(run.quantity("fluid_balance_error"), 0, 1e-9 * 4e-9);
  });
}

/// Rock, wall, wall and rock in series: 2 mu/k + 2/kappa(t).
TEST(FractureFlowInTime, FlowThroughTheWallsFollowsTheirPermeability) {
  SceneRun run = SceneRun::from_text(crossed(
      "initial_aperture: 1 mm, viscosity: 1 Pa*s, fluid_compressibility: 0 1/Pa, normal_permeability: constant, "
      "normal_permeability_value: (1 + t) m/(Pa*s)",
      ", pore: {type: matrix_flow/mpfa, permeability: (1 + t/2) m^2, viscosity: 1 Pa*s, storage: 0 1/Pa, "
      "boundary: {left: {pressure: 1 Pa}, right: {pressure: 0 Pa}}}}, couplers: [{type: wall_exchange, between: "
      "[pore, conduit]}], schedule: [{solve: [pore, conduit]}]"));
  run.run_until(4, [&] {
    const double flux = 1 / (2 / (1 + run.time() / 2) + 2 / (1 + run.time()));
    for (const double lambda : run.field("pore.wall_flux"))
      EXPECT_NEAR(std::abs(lambda), flux, 1e-10 * flux) << run.time();
  });
}

/// T = −alpha p n where nothing but the fluid acts on the walls.
TEST(FractureFlowInTime, FluidPushesWithThePartOfItsTime) {
  SceneRun run = SceneRun::from_text(
      crossed("initial_aperture: 1 mm, viscosity: 1 mPa*s, fluid_compressibility: 1e-9 1/Pa, prescribed: {all: "
              "{pressure: 1 MPa}}",
              ", rock: {type: poromechanics/mpsa, young_modulus: 1 GPa, poisson_ratio: 0.2, boundary: {left: "
              "{displacement: [0 m, 0 m]}, right: {displacement: [0 m, 0 m]}}}}, couplers: [{type: wall_traction, "
              "between: [rock, conduit], fracture_biot_coefficient: 1 - t/10}], schedule: [{solve: [rock, conduit]}]"));
  run.run_until(4, [&] {
    for (int i = 0; i < run.mesh().fracture_cell_count(); ++i)
      EXPECT_NEAR(run.field("rock.wall_traction")[2 * i], -1e6 * (1 - run.time() / 10), 1e-9 * 1e6) << run.time();
  });
}

}  // namespace
}  // namespace sprekk::testing
