// Laws of contact as formulas: every built-in law written as a formula has its answer and its iterations, and formulas
// of slip rate and pressure have closed forms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/verification/contact_patch.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

/// A strain in which the inclined fracture has this traction (normal, tangential) on its plus wall, and no stress along
/// it (lambda = G = 1).
Tensor strain_of(const Point& traction) {
  const Point n(0.5, -std::sqrt(3) / 2), t(std::sqrt(3) / 2, 0.5);
  const Tensor stress = traction[0] * n * n.transpose() + traction[1] * (n * t.transpose() + t * n.transpose());
  return 0.5 * (stress - 0.25 * stress.trace() * Tensor::Identity());
}

/// The patch whose contact has these laws in place of its friction and its dilation.
std::string scene(const std::string& type, const Point& traction, const Point& jump, const std::string& laws) {
  std::string text = patch_scene(fmt::format("{:.17g}", jump[0]), fmt::format("{:.17g}", jump[1]), 7, "8 rad",
                                 strain_of(traction), "triangles", "", type);
  const std::string usual = "friction: 7, dilation_angle: 8 rad";
  return text.replace(text.find(usual), usual.size(), laws);
}

const std::array types = {"coulomb", "augmented_lagrangian", "penalty"};

struct Twins {
  Point traction, jump;
  const char *law, *formula;
};

class LawsAsFormulas : public ::testing::TestWithParam<Twins> {};

TEST_P(LawsAsFormulas, HaveTheAnswersOfBuiltInLaws) {
  const auto& [traction, jump, law, formula] = GetParam();
  for (const char* type : types) {
    SceneRun known = SceneRun::from_text(scene(type, traction, jump, law));
    SceneRun run = SceneRun::from_text(scene(type, traction, jump, formula));
    ASSERT_TRUE(known.step() && run.step()) << type << " " << formula;
    EXPECT_EQ(run.iterations(), known.iterations()) << type << " " << formula;
    for (const char* field : {"contact.traction", "contact.jump", "rock.displacement"}) {
      const Vector difference = run.field(field) - known.field(field);
      EXPECT_LE(difference.lpNorm<Eigen::Infinity>(), 1e-12 * known.field(field).lpNorm<Eigen::Infinity>())
          << type << " " << field << " " << formula;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    all, LawsAsFormulas,
    ::testing::Values(Twins{{-0.02, 0.01}, {0, 2e-3}, "friction: 0.5", "friction: \"0.5 + 0*slip/m\""},
                      Twins{{-0.02, -0.009}, {0, 0}, "friction: 0.5", "friction: \"0.5 + 0*slip_rate*s/m\""},
                      Twins{{-0.02, 0.01},
                            {4e-4, 1e-3},
                            "friction: 0.6, weakening: {distance: 2 mm, friction: 0.4}",
                            "friction: \"0.6 - min(1, path/(2 mm))*(0.6 - 0.4)\""},
                      Twins{{-0.02, -0.008},
                            {0, -3e-3},
                            "friction: 0.6, weakening: {distance: 2 mm, friction: 0.4}",
                            "friction: \"0.6 - min(1, path/(2 mm))*(0.6 - 0.4)\""},
                      Twins{{-0.02, 0.013},
                            {0, 5e-4},
                            "friction: 0.5, cohesion: 4 mPa",
                            "friction: 0.5, cohesion: \"4 mPa + 0 Pa*slip/m\""},
                      Twins{{-0.02, 0.01},
                            {4e-4, 2e-3},
                            "friction: 0.5, dilation_angle: 0.2 rad",
                            "friction: 0.5, dilation: \"slip*tan(0.2)\""},
                      Twins{{-0.02, -0.01},
                            {2e-4, -4e-3},
                            "friction: 0.5, dilation_angle: 0.2 rad, dilation_limit: 1 mm",
                            "friction: 0.5, dilation: \"min(slip, 1 mm)*tan(0.2)\""},
                      Twins{{-0.02, 0.003},
                            {-0.02 / 8, 0},
                            "friction: 1, closure: {law: linear, stiffness: 8 Pa/m}",
                            "friction: 1, closure: {law: formula, closure: \"sigma_n/(8 Pa/m)\"}"},
                      Twins{{-0.02, 0.002},
                            {-0.001, 0},
                            "friction: 1, closure: {law: barton_bandis, stiffness: 5 Pa/m, largest: 3 mm}",
                            "friction: 1, closure: {law: formula, closure: \"sigma_n*3 mm/(5 Pa/m*3 mm + sigma_n)\"}"},
                      Twins{{0, 0}, {1e-3, 5e-4}, "friction: 0.5", "friction: \"0.5 + 0*slip/m\""}));

/// How stiff the springs of a penalty are does not depend on the friction, and so not on how it is written.
TEST(ContactFormulas, OfAPenaltyKeepItsSprings) {
  const Point traction(-0.02, 0.01), jump(5e-3, 2e-3);
  SceneRun known = SceneRun::from_text(scene("penalty", traction, jump, "friction: 0.4, dilation_angle: 1.2 rad"));
  SceneRun run = SceneRun::from_text(
      scene("penalty", traction, jump, "friction: \"0.4 + 0*slip/m\", dilation: \"slip*tan(1.2)\""));
  ASSERT_TRUE(known.step() && run.step());
  const Vector difference = run.field("contact.jump") - known.field("contact.jump");
  EXPECT_LE(difference.lpNorm<Eigen::Infinity>(), 1e-12 * known.field("contact.jump").lpNorm<Eigen::Infinity>());
}

/// Jumps and tractions of a patch that slips, against those that fulfil the law.
void expect_uniform(const Point& traction, const Point& jump, const std::string& laws) {
  for (const double factor : {1.0, 1 + 1e-9}) {
    SceneRun run = SceneRun::from_text(scene("coulomb", traction, factor * jump, laws));
    ASSERT_TRUE(run.step()) << laws;
    EXPECT_LE(run.iterations(), 8) << laws;
    for (int i = 0; i < run.mesh().fracture_cell_count(); ++i)
      for (int k = 0; k < 2; ++k) {
        EXPECT_NEAR(run.field("contact.traction")[2 * i + k], traction[k], 3e-9 * traction.norm()) << laws;
        EXPECT_NEAR(run.field("contact.jump")[2 * i + k], jump[k], 3e-9 * jump.norm() + 1e-12) << laws;
      }
  }
}

TEST(ContactFormulas, OfSlipRateAndPressureHaveClosedForms) {
  for (const double sign : {1.0, -1.0}) {
    const double slip = 3e-3, pressure = 0.02;
    // Steps of 1 s: the slip rate is 3 mm/s.
    const double by_rate = 0.5 + 0.02 * std::asinh(slip / (2 * 1e-3));
    expect_uniform({-pressure, sign * by_rate * pressure}, {0, sign * slip},
                   "friction: \"0.5 + 0.02*asinh(slip_rate/(2*1 mm/s))\"");
    const double by_pressure = 0.3 + 0.4 / (1 + pressure / 0.05);
    expect_uniform({-pressure, sign * by_pressure * pressure}, {0, sign * slip},
                   "friction: \"0.3 + 0.4/(1 + sigma_n/(50 mPa))\"");
    const double by_slip = 0.3 + 0.3 * std::exp(-slip / 4e-3), cohesion = 0.002 * std::exp(-slip / 1e-2);
    const double opening = 1e-3 * (1 - std::exp(-slip / 2e-3));
    expect_uniform({-pressure, sign * (by_slip * pressure + cohesion)}, {opening, sign * slip},
                   "friction: \"0.3 + 0.3*exp(-slip/(4 mm))\", cohesion: \"2 mPa*exp(-slip/(1 cm))\", dilation: \"1 "
                   "mm*(1 - exp(-slip/(2 mm)))\"");
    // Barton's envelope of strength: mu = tan(phi + JRC log10(JCS/sigma_n)).
    const double barton = std::tan(0.5 + 0.1 * std::log10(2 / pressure));
    expect_uniform({-pressure, sign * barton * pressure}, {0, sign * slip},
                   "friction: \"tan(0.5 + 0.1*log10(2 Pa/max(sigma_n, 1e-6 Pa)))\"");
  }
}

TEST(ContactFormulas, RefuseWhatHasNoMeaning) {
  const auto refused = [](const std::string& laws) {
    try {
      SceneRun run = SceneRun::from_text(scene("coulomb", {-0.02, 0.01}, {0, 1e-3}, laws));
      run.step();
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const auto& [laws, message] : std::vector<std::pair<std::string, std::string>>{
           {"friction: \"0.6 - slp/m\"", "did you mean 'slip'?"},
           {"friction: \"if(slip < 1 mm, 0.6, 0.3)\"", "'friction' jumps from 0.6 to 0.3 at slip = 0.001 m"},
           {"friction: \"0.6 - slip\"", "has another unit, or a term without one"},
           {"friction: \"0.6 - a/m\"", "unknown name in the expression '0.6 - a/m': 'a' (it is not one of:"},
           {"friction: \"0.5 - 1e4*slip/m\"", "'friction' is "},
           {"friction: 0.5, dilation: \"1 mm + slip\"", "'dilation' is 0.001 m without slip"},
           {"friction: 0.5, dilation: 1 mm", "'dilation' does not depend on the slip"},
           {"friction: 0.5, dilation_angle: 3 deg, dilation: slip", "'dilation' and 'dilation_angle' exclude"},
           {"friction: 0.5, closure: {law: formula}", "'closure' is missing"},
           {"friction: 0.5, closure: {closure: \"sigma_n*1 m/Pa\"}", "'closure' has no effect"},
           {"friction: \"0.6 - path/(1 m)\", weakening: {distance: 1 mm, friction: 0.1}", "is a formula, and changes"}})
    EXPECT_THAT(refused(laws), ::testing::HasSubstr(message)) << laws;
}

}  // namespace
}  // namespace sprekk::testing
