// Scenes with other components, turned by 30 degrees, and on a mesh that is moved by 1e-9 of its cells: the same
// answers.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "framework/mesh/build_mesh.hpp"
#include "tests/verification/mesh_file.hpp"
#include "tests/verification/scene_run.hpp"
#include "tests/verification/swaps.hpp"

namespace sprekk::testing {
namespace {

std::string name_of_choice(const ::testing::TestParamInfo<Choice>& info) { return name_of(info.param); }

/// A scene of configs/ and what its twins need.
struct Case {
  std::string config, mesh, boundary;  ///< the scene, its mesh, and the conditions of its rock along normals
  double size;                         ///< of the smallest cells, m
  double end;                          ///< s
};

enum class Twin { as_drawn, turned, disturbed };

/// Nodes that are on no side and on no fracture move by up to 1e-9 of `size`.
RawMesh disturbed(RawMesh mesh, double size) {
  std::vector<char> stays(mesh.nodes.size(), 0);
  for (const auto& edge : mesh.boundary_faces)
    for (const int node : edge.nodes) stays[node] = 1;
  for (const auto& fracture : mesh.fractures)
    for (const int node : fracture.nodes) stays[node] = 1;
  std::mt19937 random(20);
  std::uniform_real_distribution<double> share(-1, 1);
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    const Point motion(share(random), share(random));
    if (!stays[i]) mesh.nodes[i] += 1e-9 * size * motion;
  }
  return mesh;
}

/// What does not depend on the place of the box: norms over the rock, and values along and across fractures.
struct Answers {
  double of_pressure = 0, of_displacement = 0;
  Vector jump, traction;
  std::vector<double> intensities;
};

/// Runs a twin on the mesh of the scene itself, node by node.
Answers answers_of(const Case& scene, const Choice& choice, Twin twin) {
  const RawMesh mesh = to_raw_mesh(SceneRun(scene.config, with(choice, {{"mesh", scene.mesh}})).mesh());
  const bool is_turned = twin == Twin::turned;
  const std::string file =
      write_msh(twin == Twin::disturbed ? disturbed(mesh, scene.size) : mesh, turned_by(is_turned ? 30 : 0),
                is_turned ? Point(0.3, -0.7) : Point(0, 0), "twin_" + name_of(choice));
  SceneRun run(scene.config, with(choice, {{"geometry", "null"},
                                           {"geometry", "{file: " + file + "}"},
                                           {"mesh", "null"},
                                           {"components.rock.boundary", "null"},
                                           {"components.rock.boundary", scene.boundary},
                                           {"output.probes", "null"}}));
  run.run_until(scene.end);
  Answers answers;
  if (!std::get<0>(choice).empty()) answers.of_pressure = run.field("pore.pressure").norm();
  answers.of_displacement = run.field("rock.displacement").norm();  // of cells, or of nodes
  if (run.mesh().fracture_cell_count() > 0) {
    answers.jump = run.field("contact.jump");
    answers.traction = run.field("contact.traction");
  }
  if (scene.config == "paper/onset.yaml")
    for (const char* name : {"tips.main_first.K_II", "tips.main_last.K_II"})
      answers.intensities.push_back(run.quantity(name));
  return answers;
}

/// `intensity`: relative, of the stress intensity factors, whose fine mesh is another one in the turned box.
void expect_same(const Answers& twin, const Answers& drawn, double tolerance, double intensity) {
  EXPECT_NEAR(twin.of_pressure, drawn.of_pressure, tolerance * drawn.of_pressure);
  EXPECT_NEAR(twin.of_displacement, drawn.of_displacement, tolerance * drawn.of_displacement);
  ASSERT_EQ(twin.jump.size(), drawn.jump.size());
  if (drawn.jump.size() > 0) {
    EXPECT_LT((twin.jump - drawn.jump).lpNorm<Eigen::Infinity>(), tolerance * drawn.jump.lpNorm<Eigen::Infinity>());
    EXPECT_LT((twin.traction - drawn.traction).lpNorm<Eigen::Infinity>(),
              tolerance * drawn.traction.lpNorm<Eigen::Infinity>());
  }
  for (std::size_t i = 0; i < drawn.intensities.size(); ++i)
    EXPECT_NEAR(twin.intensities[i] / drawn.intensities[i], 1, intensity);
}

class SwapsTwins : public ::testing::TestWithParam<Choice> {
 protected:
  static void expect_twins(const Case& scene, double tolerance, double intensity = 0) {
    const Answers drawn = answers_of(scene, GetParam(), Twin::as_drawn);
    ASSERT_GT(drawn.of_displacement, 0);
    expect_same(answers_of(scene, GetParam(), Twin::turned), drawn, tolerance, intensity);
    expect_same(answers_of(scene, GetParam(), Twin::disturbed), drawn, tolerance, intensity);
  }
};

const std::string rollers = "left: {displacement_normal: 0 m}, bottom: {displacement_normal: 0 m}";

class SwapsTwinsInMandel : public SwapsTwins {};
INSTANTIATE_TEST_SUITE_P(Pairs, SwapsTwinsInMandel,
                         ::testing::Combine(::testing::Values("mpfa", "tpfa", "rt0", "ntpfa"),
                                            ::testing::Values("mpsa", "fem_first", "fem_second"),
                                            ::testing::Values("")),
                         name_of_choice);

TEST_P(SwapsTwinsInMandel, HaveTheSamePressures) {
  expect_twins({"verification/mandel.yaml", "{size: 0.12 m}",
                "{" + rollers +
                    ", top: {displacement_normal: {table: " SPREKK_SOURCE_DIR
                    "/configs/verification/mandel_plate.csv, column: u_y, of: t}}}",
                0.1, 10790},
               1e-7);
}

class SwapsTwinsInCracks : public SwapsTwins {};
INSTANTIATE_TEST_SUITE_P(Pairs, SwapsTwinsInCracks,
                         ::testing::Combine(::testing::Values(""), ::testing::Values("mpsa", "fem_first", "fem_second"),
                                            ::testing::Values("coulomb", "augmented_lagrangian", "penalty")),
                         name_of_choice);

TEST_P(SwapsTwinsInCracks, SlipAlike) {
  expect_twins({"verification/frictional_crack.yaml", "{size: 40 m, fracture_size: 0.25 m, growth: 0.25}",
                "{" + rollers + ", right: {normal_stress: -100 MPa}}", 0.2, 1},
               1e-6);
}

class SwapsTwinsInSection51 : public SwapsTwins {};
INSTANTIATE_TEST_SUITE_P(Sample, SwapsTwinsInSection51,
                         ::testing::Values(Choice("rt0", "mpsa", "coulomb"),
                                           Choice("rt0", "fem_second", "augmented_lagrangian"),
                                           Choice("mpfa", "fem_first", "coulomb"), Choice("ntpfa", "mpsa", "coulomb")),
                         name_of_choice);

/// Section 5.1 of the paper, while fluid is injected.
TEST_P(SwapsTwinsInSection51, SlipAndLoadTheTipsAlike) {
  expect_twins({"paper/onset.yaml", "{size: 0.25 m, fracture_size: 20 mm, growth: 0.3}",
                "{" + rollers + ", right: {normal_stress: -20 MPa}, top: {normal_stress: -10 MPa}}", 0.02, 9 * 3600},
               1e-6, 2e-3);
}

}  // namespace
}  // namespace sprekk::testing
