// Contact, friction and opening against closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/contact_patch.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

void expect_patch(const std::string& scene, const Point& jump, const Point& traction, double tolerance) {
  SceneRun run = SceneRun::from_text(scene);
  ASSERT_TRUE(run.step());
  for (int i = 0; i < run.mesh().fracture_cell_count(); ++i) {
    for (int k = 0; k < 2; ++k) {
      EXPECT_NEAR(run.field("contact.jump")[2 * i + k], jump[k], tolerance) << "cell " << i << " axis " << k;
      EXPECT_NEAR(run.field("contact.traction")[2 * i + k], traction[k], tolerance) << "cell " << i << " axis " << k;
    }
  }
  EXPECT_LE(run.iterations(), 6);
}

// Jumps are up to 1e-3 and tractions up to 0.06: 1e-12 is 1e-9 of them.
class ContactPatch : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Cells, ContactPatch, ::testing::Values("triangles", "quadrilaterals"),
                         [](const auto& info) { return std::string(info.param); });

TEST_P(ContactPatch, Sticks) {
  expect_patch(patch_scene("0", "0", 1.0, "0", uniform_strain(), GetParam()), Point::Zero(), uniform_traction(), 1e-12);
}

TEST_P(ContactPatch, Opens) {
  // A strain whose stress s t⊗t leaves the fracture without traction, and a rigid jump that opens it.
  expect_patch(patch_scene("1e-3", "0", 0.5, "0", traction_free_strain(), GetParam()), {1e-3, 0}, Point::Zero(), 1e-12);
}

TEST_P(ContactPatch, SlipsWithDilation) {
  // Friction that the uniform traction just reaches: f_t = mu |f_n| holds for the uniform state.
  const Point traction = uniform_traction();
  const double friction = std::abs(traction[1] / traction[0]);
  const double slip = traction[1] > 0 ? 1e-3 : -1e-3, opening = 1e-3 * std::tan(10 * M_PI / 180);
  expect_patch(patch_scene(fmt::format("{:.17g}", opening), fmt::format("{:.17g}", slip), friction, "10 deg",
                           uniform_strain(), GetParam()),
               {opening, slip}, traction, 1e-12);
}

struct CrackErrors {
  double all, inner;  ///< relative L2 error of the jump over all of the crack, and without its outer 15 %
};

CrackErrors crack_errors(SceneRun& run, int axis, double peak) {
  double error = 0, norm = 0, inner_error = 0, inner_norm = 0;
  for (int i = 0; i < run.mesh().fracture_cell_count(); ++i) {
    const FractureCell& cell = run.mesh().fracture_cells[i];
    const double x = cell.center.norm();
    const double exact = peak * std::sqrt(std::max(0.0, 1 - x * x));
    const double difference = std::abs(run.field("contact.jump")[2 * i + axis]) - exact;
    error += cell.measure * difference * difference;
    norm += cell.measure * exact * exact;
    if (x > 0.85) continue;
    inner_error += cell.measure * difference * difference;
    inner_norm += cell.measure * exact * exact;
  }
  return {std::sqrt(error / norm), std::sqrt(inner_error / inner_norm)};
}

/// The grading is refined with the crack: its error is of second order too.
std::string graded(double size) {
  return "{size: 32 m, fracture_size: " + std::to_string(size) + ", growth: " + std::to_string(2 * size) + "}";
}

// The tips' own part of the error falls fastest, so that the order rises with the mesh to that of the rock around.
TEST(Cracks, PressurizedCrackOpensLikeSneddons) {
  const double peak = 4 / (10e9 / (1 - 0.04)) * 1e6;
  std::vector<double> errors;
  for (const double size : {0.1, 0.05, 0.025}) {
    SceneRun run("verification/pressurized_crack.yaml", {{"mesh", graded(size)}});
    ASSERT_TRUE(run.step());
    errors.push_back(crack_errors(run, 0, peak).all);
  }
  EXPECT_LT(errors[0], 0.0035);
  EXPECT_LT(errors[1], 0.0012);
  EXPECT_LT(errors[2], 0.00036);
  EXPECT_GT(std::log2(errors[1] / errors[2]), 1.7) << errors[1] << " " << errors[2];
}

TEST(Cracks, FrictionalCrackSlipsLikePhans) {
  const double normal = 100e6 * std::pow(std::sin(20 * M_PI / 180), 2);
  const double shear = 100e6 * std::sin(20 * M_PI / 180) * std::cos(20 * M_PI / 180);
  const double drop = shear - normal * std::tan(30 * M_PI / 180);
  const double peak = 4 / (25e9 / (1 - 0.0625)) * drop;
  EXPECT_NEAR(peak, 3.808e-3, 1e-6);
  CrackErrors previous{};
  for (const double size : {0.05, 0.025}) {
    SceneRun run("verification/frictional_crack.yaml", {{"mesh", graded(size)}});
    ASSERT_TRUE(run.step());
    const CrackErrors errors = crack_errors(run, 1, peak);
    if (previous.all > 0) {
      EXPECT_LT(previous.all, 0.0008);
      EXPECT_LT(errors.all, 0.00025);
      EXPECT_LT(errors.inner, 0.00025);
      EXPECT_GT(std::log2(previous.all / errors.all), 1.65) << previous.all << " " << errors.all;
      EXPECT_GT(std::log2(previous.inner / errors.inner), 1.7) << previous.inner << " " << errors.inner;
    }
    previous = errors;
  }
}

}  // namespace
}  // namespace sprekk::testing
