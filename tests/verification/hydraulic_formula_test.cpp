// The transmissivity as a formula of the state: built-in laws written as formulas have their answers, a formula of the
// pressure has a closed form, and one of the normal stress has the same answer in every scheme.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

using ::testing::HasSubstr;

/// A fluid of 1 Pa s flows along a fracture of 1 m, turned by `angle`, from 1 Pa to `end`, past a dead end.
std::string fluid(const std::string& law, double angle, double size, const std::string& aperture,
                  const std::string& end = "0 Pa") {
  const double x = std::cos(angle), y = std::sin(angle);
  return fmt::format(R"yaml(
geometry:
  box: {{x: [-2 m, 2 m], y: [-2 m, 2 m]}}
  fractures:
    main: {{points: [[0 m, 0 m], [{0:.17g} m, {1:.17g} m]]}}
    across: {{points: [[{2:.17g} m, {3:.17g} m], [{4:.17g} m, {5:.17g} m]]}}
mesh: {{size: 0.8 m, fracture_size: {6} m}}
components:
  conduit:
    type: fracture_flow/tpfa
    viscosity: 1 Pa*s
    fluid_compressibility: 1e-3 1/Pa
    initial_aperture: "{7}"
    {8}
    prescribed:
      from: {{at: [0 m, 0 m], pressure: 1 Pa}}
      to: {{at: [{0:.17g} m, {1:.17g} m], pressure: {9}}}
schedule: [{{solve: [conduit]}}]
time: {{end: 3e9 s, step: 1e9 s}}
)yaml",
                     x, y, 0.5 * x - 0.3 * y, 0.5 * y + 0.3 * x, 0.5 * x + 0.2 * y, 0.5 * y - 0.2 * x, size, aperture,
                     law, end);
}

double flux(SceneRun& run) { return run.quantity("conduit.from.rate"); }

TEST(HydraulicFormulas, OfBuiltInLawsHaveTheirAnswers) {
  for (const auto& [law, formula] : std::vector<std::pair<std::string, std::string>>{
           {"transmissivity: cubic_law", "transmissivity: \"a^3/12\""},
           {"law: {type: rough, roughness: 0.01 m}",
            "law: {type: formula, transmissivity: \"a^3/12/(1 + 6*(0.01 m/a)^1.5)\"}"},
           {"law: {type: cubic, residual: 2 cm}", "law: {type: formula, transmissivity: \"a^3/12\", residual: 2 cm}"},
           {"law: {type: cubic, inertia: 3 1/m}", "law: {type: formula, transmissivity: \"a^3/12\", inertia: 3 1/m}"},
           {"law: {type: cubic}",
            "law: {type: formula, transmissivity: {fractures: {main: \"a^3/12\", default: \"a*a^2/12\"}}}"}}) {
    SceneRun known = SceneRun::from_text(fluid(law, 0.4, 0.1, "(0.01 + 0.02*(x + 1)) m"));
    SceneRun run = SceneRun::from_text(fluid(formula, 0.4, 0.1, "(0.01 + 0.02*(x + 1)) m"));
    while (known.time() < 3e9) {
      ASSERT_TRUE(known.step() && run.step()) << formula;
      EXPECT_EQ(run.iterations(), known.iterations()) << formula;
    }
    for (const char* field : {"conduit.pressure", "conduit.flux"})
      EXPECT_LT((run.field(field) - known.field(field)).lpNorm<Eigen::Infinity>(),
                1e-11 * known.field(field).lpNorm<Eigen::Infinity>())
          << formula << " " << field;
  }
}

/// With K = K_0 (1 + p/p_0) the steady flux over the distance d is K_0/(mu d) (p + p^2/(2 p_0)), between the ends.
TEST(HydraulicFormulas, OfThePressureHasItsClosedForm) {
  const double known = 1e-6 / 12 * ((1 + 0.5 / 0.5) - (0.2 + 0.5 * 0.04 / 0.5));
  for (const double angle : {0.0, 0.4, 2.1}) {
    double before = 0;
    for (const double size : {0.1, 0.05}) {
      SceneRun run =
          SceneRun::from_text(fluid("transmissivity: \"a^3/12*(1 + p/(0.5 Pa))\"", angle, size, "1 cm", "0.2 Pa"));
      while (run.time() < 3e9) {
        ASSERT_TRUE(run.step());
        EXPECT_LE(run.iterations(), 5);  // quadratic: 1e-1, 1e-2, 1e-4, 1e-8 of the answer
      }
      // The centres beside the ends have their pressures.
      const double error = std::abs(flux(run) * (1 - size) / known - 1);
      EXPECT_LT(error, 0.5 * size * size);
      if (before > 0) {
        EXPECT_GT(before / error, 3) << angle;
      }
      before = error;
    }
  }
}

/// With K = K_0/(1.5 - p/p_0) the pressure is 1.5 p_0 (1 - exp(-q mu d/(K_0 p_0))) where q flows in, at d from the
/// place without pressure. The first update, from no pressure, leads to 1.57 p_0, where K is negative.
TEST(HydraulicFormulas, MayHaveNoValueWhereASearchPasses) {
  const double rate = 9.16e-8, size = 0.05, known = 1.5 * (1 - std::exp(-rate * (1 - size) * 12e6));
  for (const double angle : {0.0, 2.1}) {
    std::string scene = fluid("transmissivity: \"a^3/12/(1.5 - p/(1 Pa))\"", angle, size, "1 cm");
    const std::string given = "from: {at: [0 m, 0 m], pressure: 1 Pa}";
    scene.replace(scene.find(given), given.size(), "");
    scene.replace(scene.find("    prescribed:"), 0,
                  fmt::format("    injection: {{well: {{at: [0 m, 0 m], rate: {} m^2/s}}}}\n", rate));
    SceneRun run = SceneRun::from_text(scene);
    while (run.time() < 3e9) ASSERT_TRUE(run.step());
    EXPECT_NEAR(run.quantity("conduit.well.pressure") / known, 1, 0.2 * size * size);
  }
}

/// Fluid is injected into a fracture whose walls press each other, and conducts less where they do.
std::string pressed(const std::string& schedule, const std::string& formula, double factor = 1) {
  return fmt::format(R"yaml(
geometry:
  box: {{x: [-6 m, 6 m], y: [-6 m, 6 m]}}
  fractures: {{cut: {{points: [[-1.8 m, -0.7 m], [1.9 m, 0.8 m]]}}}}
mesh: {{size: 2 m, fracture_size: 0.3 m}}
components:
  rock:
    type: poromechanics/mpsa
    young_modulus: 20 GPa
    poisson_ratio: 0.2
    initial_stress: {{xx: -12 MPa, yy: -9 MPa, xy: 1 MPa}}
    boundary:
      left: {{displacement: [0 m, 0 m]}}
      right: {{displacement: [0 m, 0 m]}}
      bottom: {{displacement: [0 m, 0 m]}}
      top: {{displacement: [0 m, 0 m]}}
  conduit:
    type: fracture_flow/tpfa
    viscosity: 1 mPa*s
    fluid_compressibility: 4e-10 1/Pa
    initial_aperture: 0.2 mm
    transmissivity: "{1}"
    injection: {{well: {{at: [-1.5 m, -0.6 m], rate: {2:.17g} m^2/s}}}}
  contact: {{type: contact/coulomb, friction: 0.6, closure: {{law: linear, stiffness: 100 GPa/m}}}}
couplers:
  - {{type: wall_traction, between: [rock, contact, conduit]}}
  - {{type: aperture, between: [contact, conduit]}}
schedule: {0}
time: {{end: 60 s, step: 20 s}}
)yaml",
                     schedule, formula, 4e-6 * factor);
}

TEST(HydraulicFormulas, OfTheNormalStressHaveOneAnswerInEveryScheme) {
  const std::string formula = "a^3/12*exp(-sigma_n/(5 MPa))";
  SceneRun whole = SceneRun::from_text(pressed("[{solve: [rock, conduit, contact]}]", formula));
  SceneRun split = SceneRun::from_text(pressed(
      "[{iterate: {fallback: none, until: {relative: 1e-10, at_most: 400}, steps: [{solve: [rock, contact]}, {solve: "
      "conduit, stabilize: response}]}}]",
      formula));
  SceneRun disturbed = SceneRun::from_text(pressed("[{solve: [rock, conduit, contact]}]", formula, 1 + 1e-9));
  SceneRun without = SceneRun::from_text(pressed("[{solve: [rock, conduit, contact]}]", "a^3/12"));
  for (SceneRun* run : {&whole, &split, &disturbed, &without}) run->run();
  EXPECT_LE(whole.iterations(), 6);
  for (const char* field : {"conduit.pressure", "contact.traction", "conduit.aperture"}) {
    const double size = whole.field(field).lpNorm<Eigen::Infinity>();
    EXPECT_LT((split.field(field) - whole.field(field)).lpNorm<Eigen::Infinity>(), 1e-6 * size) << field;
    EXPECT_LT((disturbed.field(field) - whole.field(field)).lpNorm<Eigen::Infinity>(), 1e-7 * size) << field;
  }
  const auto drop = [](SceneRun& run) {
    const Vector p = run.field("conduit.pressure");
    return p.maxCoeff() - p.minCoeff();
  };
  EXPECT_GT(drop(whole), 1.5 * drop(without));
}

/// Unstabilized passes reach pressures of -1e9 MPa, for which the formula is not made; the fallback has the answer.
TEST(HydraulicFormulas, MayHaveNoValueWherePassesDiverge) {
  const std::string formula = "a^3/12*(1 + p/(200 MPa))";
  SceneRun whole = SceneRun::from_text(pressed("[{solve: [rock, conduit, contact]}]", formula));
  SceneRun split =
      SceneRun::from_text(pressed("[{iterate: {steps: [{solve: conduit}, {solve: [rock, contact]}]}}]", formula));
  for (SceneRun* run : {&whole, &split}) run->run();
  for (const char* field : {"conduit.pressure", "contact.traction", "conduit.aperture"})
    EXPECT_LT((split.field(field) - whole.field(field)).lpNorm<Eigen::Infinity>(),
              1e-8 * whole.field(field).lpNorm<Eigen::Infinity>())
        << field;
}

TEST(HydraulicFormulas, SayWhatIsMissing) {
  const auto refused = [](const std::string& law) {
    try {
      SceneRun::from_text(fluid(law, 0, 0.5, "1 cm")).step();
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(refused("transmissivity: \"a^3/12*exp(-sigma_n/MPa)\""),
              ::testing::AllOf(HasSubstr("the formula of 'transmissivity' names 'sigma_n'"),
                               HasSubstr("{type: aperture, between: [CONTACT, conduit]}")));
  EXPECT_THAT(refused("transmissivity: \"a^3/12*exp(-T/(300 K))\""),
              ::testing::AllOf(HasSubstr("names 'T'"), HasSubstr("a coupler heat_advection with 'conduit'")));
  EXPECT_THAT(refused("transmissivity: \"a^3/12*exp(-sigm_n/MPa)\""), HasSubstr("did you mean 'sigma_n'?"));
  EXPECT_THAT(refused("transmissivity: cubic_lw"), HasSubstr("did you mean 'cubic_law'?"));
  EXPECT_THAT(refused("transmissivity: \"a^2/12\""), HasSubstr("has another unit, or a term without one"));
  EXPECT_THAT(refused("transmissivity: \"a^3/12 - 1e-6 m^3\""),
              ::testing::AllOf(HasSubstr("'transmissivity' is -"), HasSubstr("a = 0.01 m (it must be >= 0")));
  EXPECT_THAT(refused("law: {type: formula}"), HasSubstr("'transmissivity' is missing"));
  EXPECT_THAT(refused("law: {type: cubic, transmissivity: \"a^3/12\"}"), HasSubstr("'type: formula'"));
}

}  // namespace
}  // namespace sprekk::testing
