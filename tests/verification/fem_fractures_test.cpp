// Finite elements with fractures: uniform states, and cracks against closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/verification/contact_patch.hpp"
#include "tests/verification/fem_errors.hpp"

namespace sprekk::testing {
namespace {

/// Jump (m) and contact traction (Pa) of each fracture cell, as vectors in space.
struct OnFracture {
  Point jump = Point::Zero(), traction = Point::Zero();
};

/// Compares the state of all fracture cells with what `exact` gives for each, to 1e-12 and 1e-11.
template <class Exact>
void expect_on_fractures(SceneRun& run, Exact exact, const std::string& which) {
  const Vector jumps = run.field("contact.jump"), tractions = run.field("contact.traction");
  for (int i = 0; i < run.mesh().fracture_cell_count(); ++i) {
    const FractureCell& cell = run.mesh().fracture_cells[i];
    const OnFracture state = exact(cell);
    EXPECT_LT((jumps.segment<2>(2 * i) - cell.to_local(state.jump)).norm(), 1e-12) << which << " cell " << i;
    EXPECT_LT((tractions.segment<2>(2 * i) - cell.to_local(state.traction)).norm(), 1e-11) << which << " cell " << i;
  }
}

void expect_patch(const std::string& scene, const Point& jump, const Point& traction) {
  SceneRun run = SceneRun::from_text(scene);
  ASSERT_TRUE(run.step());
  // Jumps are up to 1e-3 and tractions up to 0.06.
  for (int i = 0; i < run.mesh().fracture_cell_count(); ++i)
    for (int k = 0; k < 2; ++k) {
      EXPECT_NEAR(run.field("contact.jump")[2 * i + k], jump[k], 1e-12) << "cell " << i << " axis " << k;
      EXPECT_NEAR(run.field("contact.traction")[2 * i + k], traction[k], 1e-12) << "cell " << i << " axis " << k;
    }
  // The stress is uniform to 1e-10.
  const Vector stress = stress_of_cells(run);
  double spread = 0;
  for (int c = 1; c < run.mesh().cell_count(); ++c)
    spread = std::max(spread, (stress.segment<3>(3 * c) - stress.head<3>()).norm());
  EXPECT_LT(spread, 1e-10 * stress.head<3>().norm());
}

class FemPatch : public ::testing::TestWithParam<std::tuple<const char*, const char*>> {
 public:
  std::string scene(const std::string& normal_jump, const std::string& tangential_jump, double friction,
                    const std::string& dilation, const Tensor& strain) const {
    const auto [order, shape] = GetParam();
    return with_fem(patch_scene(normal_jump, tangential_jump, friction, dilation, strain, shape), order);
  }
};
INSTANTIATE_TEST_SUITE_P(Elements, FemPatch,
                         ::testing::Combine(::testing::Values("first", "second"),
                                            ::testing::Values("triangles", "quadrilaterals")),
                         [](const auto& info) {
                           return std::string(std::get<0>(info.param)) + "_" + std::get<1>(info.param);
                         });

TEST_P(FemPatch, Sticks) {
  expect_patch(scene("0", "0", 1.0, "0", uniform_strain()), Point::Zero(), uniform_traction());
}

TEST_P(FemPatch, Opens) {
  expect_patch(scene("1e-3", "0", 0.5, "0", traction_free_strain()), {1e-3, 0}, Point::Zero());
}

TEST_P(FemPatch, SlipsWithDilation) {
  const Point traction = uniform_traction();
  const double friction = std::abs(traction[1] / traction[0]);
  const double slip = traction[1] > 0 ? 1e-3 : -1e-3, opening = 1e-3 * std::tan(10 * M_PI / 180);
  expect_patch(
      scene(fmt::format("{:.17g}", opening), fmt::format("{:.17g}", slip), friction, "10 deg", uniform_strain()),
      {opening, slip}, traction);
}

/// Four blocks that a cross of fractures parts move away: each sector of the junction has a node of its own.
TEST(FemJunctions, PartFourBlocksThatMoveAway) {
  const std::string u =
      "{displacement: [\"if(x > 0.4*y, 2e-3, -1e-3)\", \"if(y > 0, 3e-3, 0) + if(x > 0.4*y, 2e-4, 0)\"]}";
  for (const char* order : {"first", "second"})
    for (const char* mesh : {"{size: 0.2}", "{size: 0.2, shape: quadrilaterals}"}) {
      SceneRun run = SceneRun::from_text(fmt::format(
          "{{geometry: {{box: {{x: [-1, 1], y: [-1, 1]}}, fractures: {{a: {{points: [[-1, 0], [1, 0]]}}, b: {{points: "
          "[[-0.4, -1], [0.4, 1]]}}}}}}, mesh: {}, components: {{rock: {{type: poromechanics/fem, order: {}, "
          "young_modulus: 2.5 Pa, poisson_ratio: 0.25, boundary: {{left: {}, right: {}, bottom: {}, top: {}}}}}, "
          "contact: {{type: contact/coulomb, friction: 0.5}}}}, couplers: [{{type: wall_traction, between: [rock, "
          "contact]}}], schedule: [{{solve: [rock, contact]}}], time: {{end: 1 s, step: 1 s}}}}",
          mesh, order, u, u, u, u));
      ASSERT_TRUE(run.step());
      ASSERT_EQ(run.mesh().junctions.size(), 1u);
      const auto parted = [](const FractureCell& cell) -> OnFracture {
        return {.jump = cell.fracture == 0 ? Point(0, -3e-3) : Point(3e-3, 2e-4)};  // of the minus wall
      };
      expect_on_fractures(run, parted, std::string(mesh) + order);
    }
}

/// Fractures that cross, touch and end in rock under a uniform strain hold: nothing jumps, and tractions are those of
/// the uniform stress, at tips as well.
TEST(FemJunctions, HoldUnderUniformStressWithTheirTips) {
  const std::string fractures =
      "{a: {points: [[-1, 0.1], [0.8, 0.1]]}, b: {points: [[-0.9, -0.2], [0.9, 0.455]]}, c: {points: [[0.5, 0.1], "
      "[0.6, -0.9]]}, d: {points: [[0.3, -0.5], [0, -0.7]]}, e: {points: [[0.3, -0.5], [-0.2, -0.4]]}}";
  const std::string u = "{displacement: [\"-0.02*x + 0.001*y\", \"0.001*x - 0.01*y\"]}";
  const Tensor strain = uniform_strain(), stress = 2 * strain + strain.trace() * Tensor::Identity();
  for (const char* order : {"first", "second"})
    for (const char* mesh : {"{size: 0.15}", "{size: 0.15, shape: quadrilaterals}"}) {
      SceneRun run = SceneRun::from_text(fmt::format(
          "{{geometry: {{box: {{x: [-1, 1], y: [-1, 1]}}, fractures: {}}}, mesh: {}, components: {{rock: {{type: "
          "poromechanics/fem, order: {}, young_modulus: 2.5 Pa, poisson_ratio: 0.25, boundary: {{left: {}, right: {}, "
          "bottom: {}, top: {}}}}}, contact: {{type: contact/coulomb, friction: 1e6}}}}, couplers: [{{type: "
          "wall_traction, between: [rock, contact]}}], schedule: [{{solve: [rock, contact]}}], time: {{end: 1 s, step: "
          "1 "
          "s}}}}",
          fractures, mesh, order, u, u, u, u));
      ASSERT_TRUE(run.step());
      const auto held = [&](const FractureCell& cell) -> OnFracture { return {.traction = stress * cell.normal}; };
      expect_on_fractures(run, held, std::string(mesh) + order);
      const Vector of_cells = stress_of_cells(run);
      for (int c = 0; c < run.mesh().cell_count(); ++c)
        EXPECT_LT((of_cells.segment<3>(3 * c) - Eigen::Vector3d(stress(0, 0), stress(1, 1), stress(0, 1))).norm(),
                  1e-11)
            << mesh << order;
    }
}

/// Tips that grow, with the fine level around them, and a mesh that follows: the fracture slips from 5 MPa on, with
/// K_II = D sqrt(pi b), D = (5 MPa − 0.5 (15 MPa − p))/(1 + 0.5 tan 1°), and its wings start at 8.06 MPa
/// (wings_sealed.yaml). Ten cells on the fracture.
TEST(FemGrowth, WingsStartAtTheirPressureAndGrowAtTheToughness) {
  SceneRun run("verification/wings_sealed.yaml", with_fem("second", {{"time.start", "7.8 h"}, {"time.step", "0.1 h"}}));
  ASSERT_TRUE(run.step());
  const double pressure = run.quantity("fracture_pressure");
  const double drop = (5e6 - 0.5 * (15e6 - pressure)) / (1 + 0.5 * std::tan(M_PI / 180));
  const double first = std::abs(run.quantity("tips.main_first.K_II")),
               last = std::abs(run.quantity("tips.main_last.K_II"));
  EXPECT_NEAR(first, drop * std::sqrt(M_PI * 0.05), 0.03 * first);
  EXPECT_NEAR(last, drop * std::sqrt(M_PI * 0.05), 0.03 * last);
  double onset = 0;
  run.run_until(9.7 * 3600, [&] {
    const double length = run.quantity("tips.main_last.length");
    if (length == 0) return;
    if (onset == 0) onset = run.quantity("fracture_pressure");
    if (length < 0.5e-3) return;
    for (const char* tip : {"tips.main_first", "tips.main_last"}) {
      EXPECT_NEAR(run.quantity(tip + std::string(".K_I")), 0.7e6, 0.03 * 0.7e6) << tip << " " << run.time();
    }
    EXPECT_NEAR(run.quantity("tips.main_first.length"), length, 0.05 * length) << run.time();
  });
  EXPECT_GT(onset, 8.02e6);
  EXPECT_LT(onset, 8.2e6 + 1e3);
  EXPECT_GT(run.mesh_changes(), 0);
}

/// The integral of sqrt(1 − x²) from 0.
double area_of_circle(double x) {
  const double inside = std::clamp(x, -1.0, 1.0);
  return (inside * std::sqrt(1 - inside * inside) + std::asin(inside)) / 2;
}

/// Relative L2 error of a jump along a crack of half-length 1 m around the origin: of its means over cells.
double crack_error(const SceneRun& run, int axis, double peak) {
  double error = 0, norm = 0;
  for (int i = 0; i < run.mesh().fracture_cell_count(); ++i) {
    const FractureCell& cell = run.mesh().fracture_cells[i];
    const double x = cell.center.norm(), half = cell.measure / 2;
    const double exact = peak * (area_of_circle(x + half) - area_of_circle(x - half)) / cell.measure;
    const double difference = std::abs(run.field("contact.jump")[2 * i + axis]) - exact;
    error += cell.measure * difference * difference;
    norm += cell.measure * exact * exact;
  }
  return std::sqrt(error / norm);
}

std::string graded(double size) {
  return "{size: 32 m, fracture_size: " + std::to_string(size) + ", growth: " + std::to_string(2 * size) + "}";
}

// The error falls with the size of cells; quarter-point elements at tips make it five times smaller.
TEST(FemCracks, PressurizedCracksOpenLikeSneddonsHoweverTheyLie) {
  const double peak = 4 / (10e9 / (1 - 0.04)) * 1e6;
  for (const char* order : {"first", "second"})
    for (const double angle : {0.0, 37.0}) {
      const Point end(std::cos(angle * M_PI / 180), std::sin(angle * M_PI / 180));
      double previous = 0;
      for (const double size : {0.1, 0.05}) {
        if (angle != 0 && size < 0.1) continue;  // the turned twin of the coarse one
        SceneRun run("verification/pressurized_crack.yaml",
                     with_fem(order, {{"mesh", graded(size)},
                                      {"geometry.fractures.crack.points",
                                       fmt::format("[[{0:.17g} m, {1:.17g} m], [{2:.17g} m, {3:.17g} m]]", -end[0],
                                                   -end[1], end[0], end[1])}}));
        ASSERT_TRUE(run.step());
        const double error = crack_error(run, 0, peak);
        EXPECT_LT(error, std::string(order) == "second" ? 0.08 * size : 0.12 * size) << order << " " << angle;
        RecordProperty(fmt::format("{}_{}_{}", order, angle, size), fmt::format("{:.3g}", error));
        if (previous > 0) {
          EXPECT_GT(std::log2(previous / error), 0.85) << order << " " << angle << " " << error;
        }
        previous = error;
      }
    }
}

TEST(FemCracks, FrictionalCrackSlipsLikePhans) {
  const double normal = 100e6 * std::pow(std::sin(20 * M_PI / 180), 2);
  const double shear = 100e6 * std::sin(20 * M_PI / 180) * std::cos(20 * M_PI / 180);
  const double peak = 4 / (25e9 / (1 - 0.0625)) * (shear - normal * std::tan(30 * M_PI / 180));
  for (const char* order : {"first", "second"}) {
    double previous = 0;
    for (const double size : {0.1, 0.05}) {
      SceneRun run("verification/frictional_crack.yaml", with_fem(order, {{"mesh", graded(size)}}));
      ASSERT_TRUE(run.step());
      const double error = crack_error(run, 1, peak);
      EXPECT_LT(error, std::string(order) == "second" ? 0.08 * size : 0.12 * size) << order;
      RecordProperty(fmt::format("{}_{}", order, size), fmt::format("{:.3g}", error));
      if (previous > 0) {
        EXPECT_GT(std::log2(previous / error), 0.85) << order << " " << error;
      }
      previous = error;
    }
  }
}

}  // namespace
}  // namespace sprekk::testing
