// The state of the walls before the first step, and what is said of a start that is out of balance.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A fault at an angle (degrees) to x in rock under a uniform stress that its sides give, too, and fluid in the fault.
std::string fault(const std::string& rock, double angle, const std::string& contact, double scale = 1) {
  const double radians = angle * std::numbers::pi / 180, x = 30 * std::cos(radians), y = 30 * std::sin(radians);
  return fmt::format(R"(
geometry: {{box: {{x: [-100 m, 100 m], y: [-100 m, 100 m]}}, fractures: {{fault: {{points: [[{0:.17g} m, {1:.17g} m], [{2:.17g} m, {3:.17g} m]]}}}}}}
mesh: {{size: 50 m, fracture_size: 20 m}}
components:
  rock:
    type: {4}
    young_modulus: 20 GPa
    poisson_ratio: 0.25
    initial_stress: {{xx: {5:.17g} MPa, yy: {6:.17g} MPa, xy: {7:.17g} MPa}}
    boundary:
      left: {{displacement: [0, 0]}}
      right: {{traction: [{5:.17g} MPa, {7:.17g} MPa]}}
      top: {{traction: [{7:.17g} MPa, {6:.17g} MPa]}}
      bottom: {{traction: [{8:.17g} MPa, {9:.17g} MPa]}}
  conduit: {{type: fracture_flow/tpfa, viscosity: 1 mPa*s, fluid_compressibility: 4e-10 1/Pa, initial_aperture: 1 mm, initial_pressure: {10:.17g} MPa}}
  contact: {{type: contact/coulomb, {11}}}
couplers:
  - {{type: aperture, between: [contact, conduit]}}
  - {{type: wall_traction, between: [rock, contact, conduit], fracture_biot_coefficient: 0.5}}
schedule: [{{solve: [rock, contact, conduit]}}]
time: {{end: 3 s, step: 1 s}}
)",
                     -x, -y, x, y, rock, -30 * scale, -50 * scale, 5 * scale, -5 * scale, 50 * scale, 8 * scale,
                     contact);
}

Vector output(SceneRun& run, const std::string& name) {
  for (const OutputField& field : run.model().output())
    if (field.name == name) return field.values;
  throw std::logic_error("no " + name);
}

/// Reference: Cauchy's formula, and the effective traction f = T + alpha p n of the contact.
TEST(StartBalance, WallsHaveTheTractionsOfTheInitialStress) {
  for (const std::string rock : {"poromechanics/mpsa", "poromechanics/fem"})
    for (const double angle : {30.0, 120.0, -60.0})
      for (const double scale : {1.0, 1 + 1e-9}) {
        SceneRun run = SceneRun::from_text(fault(rock, angle, "friction: 0.6", scale));
        const Tensor stress = (Tensor() << -30, 5, 5, -50).finished() * 1e6 * scale;
        const double fluid = 0.5 * 8e6 * scale;
        const auto expect_state = [&](double tolerance) {
          for (int i = 0; i < run.mesh().fracture_cell_count(); ++i) {
            const FractureCell& cell = run.mesh().fracture_cells[i];
            Point traction = cell.to_local(stress * cell.normal);
            EXPECT_LT((run.field("rock.wall_traction").segment<2>(2 * i) - traction).norm(), tolerance * 5e7);
            traction[0] += fluid;
            EXPECT_LT((run.field("contact.traction").segment<2>(2 * i) - traction).norm(), tolerance * 5e7);
            EXPECT_NEAR(output(run, "contact.slip_tendency")[i], std::abs(traction[1] / traction[0]), 10 * tolerance);
          }
        };
        expect_state(1e-14);
        run.run();
        expect_state(1e-11);
        EXPECT_LT(run.field("rock.displacement").lpNorm<Eigen::Infinity>(), 1e-12);
        EXPECT_LT(run.field("contact.jump").lpNorm<Eigen::Infinity>(), 1e-12);
      }
}

/// Reference: closure counts from zero pressure, so walls under the pressure q = −f_n are closed by C(q) from the
/// start: nothing moves, and the fluid keeps its pressure.
TEST(StartBalance, WallsAreClosedFromTheStart) {
  const std::string linear = "friction: 0.6, closure: {law: linear, stiffness: 100 GPa/m}",
                    hyperbola = "friction: 0.6, closure: {law: barton_bandis, stiffness: 50 GPa/m, largest: 0.5 mm}";
  for (const std::string rock : {"poromechanics/mpsa", "poromechanics/fem"})
    for (const std::string& law : {linear, hyperbola})
      for (const double angle : {30.0, 120.0}) {
        SceneRun run = SceneRun::from_text(fault(rock, angle, law));
        const Tensor stress = (Tensor() << -30, 5, 5, -50).finished() * 1e6;
        for (const bool is_later : {false, true}) {
          if (is_later) run.run();
          for (int i = 0; i < run.mesh().fracture_cell_count(); ++i) {
            const FractureCell& cell = run.mesh().fracture_cells[i];
            const double pressure = -cell.normal.dot(stress * cell.normal) - 0.5 * 8e6;
            const double closure = law == linear ? pressure / 100e9 : pressure * 5e-4 / (50e9 * 5e-4 + pressure);
            EXPECT_NEAR(run.field("conduit.aperture")[i], 1e-3 - closure, 1e-13) << is_later;
            EXPECT_NEAR(run.field("contact.jump")[2 * i], -closure, 1e-13) << is_later;
            EXPECT_NEAR(run.field("conduit.pressure")[i], 8e6, 1e-2) << is_later;
          }
        }
        EXPECT_LT(run.field("rock.displacement").lpNorm<Eigen::Infinity>(), 1e-12);
      }
}

/// A box of rock, 400 m high, whose sides are rollers; `what` replaces parts of it.
std::string box(const std::vector<std::pair<std::string, std::string>>& what = {}, const std::string& more = "") {
  std::string text = R"(
geometry: {box: {x: [0 m, 200 m], y: [-1400 m, -1000 m]}}
mesh: {kind: structured, shape: quadrilaterals, cells: [2, 4]}
components:
  rock:
    type: poromechanics/mpsa
    young_modulus: 20 GPa
    poisson_ratio: 0.25
    rock_density: 2500 kg/m^3
    gravity: [0, -10 m/s^2]
    initial_stress: {xx: (15000*y) Pa, yy: (25000*y) Pa, xy: 0 Pa}
    boundary:
      left: {displacement_x: 0 m}
      right: {displacement_x: 0 m}
      bottom: {displacement_y: 0 m}
      top: {normal_stress: -25 MPa}
)" + more + R"(
schedule: [{solve: rock}]
time: {end: 1 s, step: 1 s}
)";
  for (const auto& [from, to] : what) {
    const auto place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    text.replace(place, from.size(), to);
  }
  return text;
}

/// What is said of the balance before the first step; empty for nothing.
std::string said(const std::string& scene) {
  SceneRun run = SceneRun::from_text(scene);
  const Notes notes = run.model().input_notes();
  for (const Notes::Note& note : notes.all())
    if (note.topic.find("out of balance") != std::string::npos) return note.text;
  return "";
}

TEST(StartBalance, AnImbalanceIsToldWithItsSizeAndPlace) {
  const std::string gravity = "gravity: [0, -10 m/s^2]", shear = "xy: 0 Pa", top = "top: {normal_stress: -25 MPa}";
  const std::string yy = "yy: (25000*y) Pa", both = "xx: (15000*y) Pa, yy: (25000*y) Pa";
  for (const std::string rock : {"poromechanics/mpsa", "poromechanics/fem"}) {
    const auto changed = [&](std::vector<std::pair<std::string, std::string>> what) {
      what.emplace_back("poromechanics/mpsa", rock);
      return said(box(what));
    };
    EXPECT_THAT(changed({}), IsEmpty());
    // A load on the top that is 5 MPa too small.
    const std::string small = changed({{top, "top: {normal_stress: -20 MPa}"}});
    EXPECT_THAT(small, HasSubstr("by 5 MPa at (50, -1000): on side 'top' the initial stress is -25 MPa"));
    EXPECT_THAT(small, HasSubstr("let 'start: settle' find the equilibrium"));
    // Twice the weight over 400 m.
    EXPECT_THAT(changed({{gravity, "gravity: [0, 10 m/s^2]"}}), HasSubstr("by 20 MPa"));
    EXPECT_THAT(changed({{gravity, "gravity: [0, 10 m/s^2]"}}), HasSubstr("let gravity act the other way"));
    EXPECT_THAT(changed({{both, "xx: (-15000*y) Pa, yy: (-25000*y) Pa"}}), HasSubstr("the other sign"));
    EXPECT_THAT(changed({{shear, "xy: 3 MPa"}}), HasSubstr("by 3 MPa"));
    const std::string light = changed({{yy, "yy: (20000*y) Pa"}, {top, "top: {normal_stress: -20 MPa}"}});
    EXPECT_THAT(light, HasSubstr("by 2 MPa"));
    EXPECT_THAT(light, HasSubstr("initial stress leaves 5000 N/m^3"));
    // The same with a perturbation.
    EXPECT_THAT(changed({{yy, "yy: (25000.000025*y) Pa"}}), IsEmpty());
  }
  EXPECT_THAT(said(box({{yy, "yy: (20000*y) Pa"}}, "start: {settle: rock}")), IsEmpty());
}

TEST(StartBalance, WallsThatMoveAtOnceAreTold) {
  EXPECT_THAT(said(fault("poromechanics/mpsa", 120, "friction: 0.6")), IsEmpty());
  // sigma_n = −39.3 MPa, f_n = −35.3 MPa and f_t = 11.2 MPa at 120 degrees: a friction of 0.2 holds 7.1 MPa.
  const std::string slides = said(fault("poromechanics/mpsa", 120, "friction: 0.2"));
  EXPECT_THAT(slides, HasSubstr("slide under the initial stress"));
  const Point normal(std::cos(std::numbers::pi / 6), std::sin(std::numbers::pi / 6));
  const Tensor stress = (Tensor() << -30, 5, 5, -50).finished();
  const double across = normal.dot(stress * normal) + 4;
  const double along = std::abs(Point(-normal.y(), normal.x()).dot(stress * normal));
  EXPECT_THAT(slides, HasSubstr(fmt::format("{:.3g} MPa across and {:.3g} MPa along", across, along)));
  EXPECT_THAT(slides, HasSubstr(fmt::format("by {:.3g} MPa more", along + 0.2 * across)));
}

}  // namespace
}  // namespace sprekk::testing
