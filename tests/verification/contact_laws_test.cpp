// The laws of contact against closed forms: a uniform strain and a rigid jump that fulfil a law on an inclined fracture
// are the solution.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/verification/contact_patch.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

/// A strain in which the fracture has this traction (normal, tangential) on its plus wall, and no stress along it
/// (lambda = G = 1).
Tensor strain_of(const Point& traction) {
  const Point n(0.5, -std::sqrt(3) / 2), t(std::sqrt(3) / 2, 0.5);
  const Tensor stress = traction[0] * n * n.transpose() + traction[1] * (n * t.transpose() + t * n.transpose());
  return 0.5 * (stress - 0.25 * stress.trace() * Tensor::Identity());
}

/// Runs the patch with these jumps and this law, in one step, and compares jumps and tractions with the uniform ones,
/// to `tolerance` of them or of the strain.
void expect_uniform_with(const std::string& type, const Point& traction, const Point& jump, double friction,
                         double dilation, const std::string& laws, double tolerance = 1e-9) {
  SCOPED_TRACE(type + " " + laws);
  SceneRun run = SceneRun::from_text(patch_scene(fmt::format("{:.17g}", jump[0]), fmt::format("{:.17g}", jump[1]),
                                                 friction, fmt::format("{:.17g} rad", dilation), strain_of(traction),
                                                 "triangles", laws, type));
  ASSERT_TRUE(run.step());
  const double pressure = std::max(traction.norm(), 1e-3), length = std::max(jump.norm(), 1e-3);
  for (int i = 0; i < run.mesh().fracture_cell_count(); ++i)
    for (int k = 0; k < 2; ++k) {
      EXPECT_NEAR(run.field("contact.traction")[2 * i + k], traction[k], tolerance * pressure) << "cell " << i;
      EXPECT_NEAR(run.field("contact.jump")[2 * i + k], jump[k], tolerance * length) << "cell " << i;
    }
}

/// The same with both types that fulfil the conditions exactly.
void expect_uniform(const Point& traction, const Point& jump, double friction, double dilation,
                    const std::string& laws) {
  for (const char* type : {"coulomb", "augmented_lagrangian"})
    expect_uniform_with(type, traction, jump, friction, dilation, ", " + laws);
}

TEST(ContactLaws, LinearClosure) {
  expect_uniform({-0.02, 0.003}, {-0.02 / 8, 0}, 1, 0, "closure: {law: linear, stiffness: 8 Pa/m}");
}

TEST(ContactLaws, BartonBandisClosure) {
  for (const double pressure : {1e-4, 0.002, 0.02, 0.3}) {
    const double closure = 0.003 * pressure / (5 * 0.003 + pressure);
    EXPECT_NEAR(pressure, 5 * closure / (1 - closure / 0.003), 1e-12);
    expect_uniform({-pressure, 0.1 * pressure}, {-closure, 0}, 1, 0,
                   "closure: {law: barton_bandis, stiffness: 5 Pa/m, largest: 3 mm}");
  }
}

TEST(ContactLaws, ClosureBesideDilation) {
  for (const double sign : {1.0, -1.0}) {
    const double slip = 2e-3, opening = slip * std::tan(0.2) - 0.02 / 8;
    expect_uniform({-0.02, sign * 0.006}, {opening, sign * slip}, 0.3, 0.2,
                   "closure: {law: linear, stiffness: 8 Pa/m}");
  }
}

TEST(ContactLaws, SlipWeakening) {
  for (const double sign : {1.0, -1.0})
    for (const double slip : {4e-4, 1e-3, 3e-3}) {  // before the end of the distance of 2 mm, and after it
      const double lost = std::min(1.0, slip / 2e-3), friction = 0.6 - lost * 0.2;
      expect_uniform({-0.02, sign * friction * 0.02}, {slip * std::tan(0.1), sign * slip}, 0.6, 0.1,
                     "weakening: {distance: 2 mm, friction: 0.4}");
    }
}

TEST(ContactLaws, CohesionThatIsLost) {
  for (const double sign : {1.0, -1.0})
    for (const double slip : {5e-4, 1.5e-3, 3e-3}) {
      const double held = 0.004 * std::max(0.0, 1 - slip / 2e-3) + 0.5 * 0.02;
      expect_uniform({-0.02, sign * held}, {0, sign * slip}, 0.5, 0, "cohesion: 4 mPa, weakening: {distance: 2 mm}");
    }
}

TEST(ContactLaws, CohesionHoldsWalls) {
  expect_uniform({-0.02, 0.0139}, {0, 0}, 0.5, 0, "cohesion: 4 mPa, weakening: {distance: 2 mm}");
}

/// Cohesion without weakening: walls that touch hold c + mu N however far they have slid, and parted walls nothing.
TEST(ContactLaws, CohesionThatStays) {
  for (const double sign : {1.0, -1.0}) {
    for (const double slip : {1e-6, 5e-4, 3e-2}) {
      expect_uniform({-0.02, sign * 0.014}, {slip * std::tan(0.1), sign * slip}, 0.5, 0.1, "cohesion: 4 mPa");
      expect_uniform({-0.02, sign * 0.004}, {0, sign * slip}, 0, 0, "cohesion: 4 mPa");  // of Tresca
    }
    expect_uniform({-0.02, sign * 0.0139}, {0, 0}, 0.5, 0, "cohesion: 4 mPa");
    expect_uniform({0, 0}, {1e-3, sign * 5e-4}, 0.5, 0.1, "cohesion: 4 mPa");
  }
}

TEST(ContactLaws, TensileStrengthThatIsLost) {
  for (const double opening : {1e-4, 1e-3, 3e-3})
    expect_uniform({0.004 * std::max(0.0, 1 - opening / 2e-3), 0}, {opening, 0}, 0.5, 0.1,
                   "tensile_strength: 4 mPa, weakening: {distance: 2 mm}");
}

TEST(ContactLaws, TensileStrengthHoldsWalls) {
  expect_uniform({0.0039, 0}, {0, 0}, 0.5, 0, "tensile_strength: 4 mPa, weakening: {distance: 2 mm}");
}

TEST(ContactLaws, DilationThatIsWorn) {
  for (const double sign : {1.0, -1.0})
    for (const double slip : {5e-4, 4e-3})
      expect_uniform({-0.02, sign * 0.01}, {std::min(slip, 1e-3) * std::tan(0.2), sign * slip}, 0.5, 0.2,
                     "dilation_limit: 1 mm");
}

TEST(ContactTypes, FulfilTheConditions) {
  const double slope = std::tan(0.1);
  for (const double sign : {1.0, -1.0})
    for (const char* type : {"coulomb", "augmented_lagrangian"}) {
      expect_uniform_with(type, {-0.02, sign * 0.009}, {0, 0}, 0.5, 0.1, "");                      // sticks
      expect_uniform_with(type, {-0.02, sign * 0.01}, {2e-3 * slope, sign * 2e-3}, 0.5, 0.1, "");  // slips
      expect_uniform_with(type, {0, 0}, {1e-3, sign * 5e-4}, 0.5, 0.1, "");                        // is open
      expect_uniform_with(type, {0, 0}, {1e-4, sign * 1e-3}, 0.5, 0, "");
    }
}

/// Largest difference of the jumps from the uniform ones where walls stick, in a patch with this penalty.
double overlap(double factor, const Point& traction) {
  SceneRun run = SceneRun::from_text(patch_scene("0", "0", 0.5, "0", strain_of(traction), "triangles",
                                                 fmt::format(", stiffness_factor: {}", factor), "penalty"));
  EXPECT_TRUE(run.step());
  return run.field("contact.jump").lpNorm<Eigen::Infinity>();
}

TEST(ContactTypes, PenaltyIsOfFirstOrderInItsCompliance) {
  const double coarse = overlap(1e3, {-0.02, 0.007}), fine = overlap(1e4, {-0.02, 0.007});
  EXPECT_GT(fine, 0);
  EXPECT_NEAR(coarse / fine, 10, 0.05);
  // Springs of k in one row: the overlap is traction over k where the rock itself is uniform.
  EXPECT_LT(fine, 1e-4 * 0.02);
}

TEST(ContactLaws, RefusesLawsWithoutMeaning) {
  const auto message = [](const std::string& laws) -> std::string {
    try {
      SceneRun::from_text(patch_scene("0", "0", 0.5, "0", uniform_strain(), "triangles", ", " + laws));
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  using ::testing::HasSubstr;
  EXPECT_EQ(message("cohesion: 1 Pa"), "accepted");
  EXPECT_THAT(message("cohesion: 1 Pa, rate_and_state: {a: 0.01, b: 0.02, distance: 1 mm, reference_rate: 1e-6 m/s, "
                      "initial_slip_rate: 1e-9 m/s}"),
              HasSubstr("'cohesion' has no effect"));
  EXPECT_THAT(message("tensile_strength: 1 Pa"), HasSubstr("never lost"));
  EXPECT_THAT(message("weakening: {friction: 0.1}"), HasSubstr("distance"));
  EXPECT_THAT(message("closure: {law: linear}"), HasSubstr("'stiffness' is missing"));
  EXPECT_THAT(message("closure: {law: barton_bandis, stiffness: 1 Pa/m}"), HasSubstr("'largest' is missing"));
  EXPECT_THAT(message("closure: {stiffness: 1 Pa/m}"), HasSubstr("no effect"));
}

}  // namespace
}  // namespace sprekk::testing
