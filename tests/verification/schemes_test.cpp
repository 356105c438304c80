// Every coupling scheme must converge to the same answer; a repeated step must give the same bits.
#include <gtest/gtest.h>

#include <cmath>

#include "framework/config/yaml/load_scene.hpp"
#include "tests/verification/same_fields.hpp"

namespace sprekk::testing {
namespace {

const char* const fixed_stress_mandel =
    "[{iterate: {fallback: none, until: {relative: 1e-11, at_most: 100}, steps: [{solve: [pore], stabilize: "
    "fixed_stress}, {solve: "
    "[rock]}]}}]";
const char* const fixed_stress_onset =
    "[{iterate: {fallback: none, until: {relative: 1e-11, at_most: 100}, steps: [{solve: [pore, conduit], stabilize: "
    "fixed_stress}, "
    "{solve: [rock, contact]}]}}]";

/// The scene of sec. 5.1 of the paper on a mesh that a test can afford: 10 cells on the fracture.
std::vector<Override> small_onset(const std::vector<Override>& more = {}) {
  std::vector<Override> overrides = {{"mesh.size", "0.25 m"}, {"mesh.fracture_size", "0.01 m"}, {"mesh.growth", "0.3"}};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return overrides;
}

TEST(Schemes, FixedStressAgreesWithMonolithicOnMandel) {
  SceneRun together("verification/mandel.yaml"), split("verification/mandel.yaml", {{"schedule", fixed_stress_mandel}});
  together.run();
  split.run();
  expect_same_fields(together, split, 1e-8);
}

TEST(Schemes, FixedStressAgreesWithMonolithicOnInjection) {
  // To the end of the injection: afterwards nothing flows along the fracture, and its flux has no size to compare with.
  SceneRun together("paper/onset_coarse.yaml", small_onset());
  SceneRun split("paper/onset_coarse.yaml", small_onset({{"schedule", fixed_stress_onset}}));
  together.run_until(21 * 3600);
  split.run_until(21 * 3600);
  expect_same_fields(together, split, 1e-8);
}

TEST(Schemes, AndersonNeedsFewerPasses) {
  const auto passes = [](int depth) {
    SceneRun run(
        "verification/mandel.yaml",
        {{"schedule", "[{iterate: {fallback: none, until: {relative: 1e-9, at_most: 100}, accelerate: {anderson: " +
                          std::to_string(depth) +
                          "}, steps: [{solve: [pore], stabilize: fixed_stress}, {solve: [rock]}]}}]"}});
    EXPECT_TRUE(run.step());
    return run.iterations();
  };
  EXPECT_LT(passes(5), passes(0));
}

TEST(Schemes, FixedStressContractsAsTheorySays) {
  // Irrotational modes contract by |L - alpha^2/M_v|/(S + L + …) <= 0.211 with L = alpha^2/K (Kim et al. 2011), which
  // bounds what the residual falls by in a pass, once the first passes are over.
  std::vector<double> residuals;
  const auto config = std::string("verification/mandel.yaml");
  for (int passes = 4; passes <= 7; ++passes) {
    SceneRun run(config, {{"schedule",
                           "[{iterate: {fallback: none, until: {relative: 1e-30, at_most: " + std::to_string(passes) +
                               "}, steps: [{solve: [pore], stabilize: fixed_stress}, {solve: [rock]}]}}]"}});
    const StepStatus status = run.model().attempt({0, 1079, 1079});
    EXPECT_FALSE(status.converged);
    residuals.push_back(run.model().fields().at("pore.pressure").now().norm());
  }
  const double ratio = std::abs((residuals[3] - residuals[2]) / (residuals[2] - residuals[1]));
  EXPECT_LT(ratio, 0.22);
}

TEST(Schemes, SplitWithoutIterationConvergesInTime) {
  // The drained split counts each change of volume one step late: an error of first order in the step.
  const auto error = [](const char* step) {
    const std::vector<Override> common = {{"time.step", step}, {"components.pore.storage", "4 1/Pa"}};
    std::vector<Override> late = common;
    late.push_back({"schedule", "[{solve: pore}, {solve: rock}]"});
    SceneRun together("verification/terzaghi.yaml", common), split("verification/terzaghi.yaml", late);
    together.run();
    split.run();
    EXPECT_LE(std::abs(split.quantity("fluid_balance_error")), 1e-12 * split.quantity("fluid_outflow"));
    return (split.field("pore.pressure") - together.field("pore.pressure")).norm();
  };
  const double coarse = error("0.005 s"), middle = error("0.0025 s"), fine = error("0.00125 s");
  EXPECT_GT(std::log2(coarse / middle), 0.8);
  EXPECT_GT(std::log2(middle / fine), 0.8);
}

TEST(Schemes, OneSubstepChangesNothing) {
  const auto subcycled = [](int count) {
    return "[{iterate: {fallback: none, until: {relative: 1e-11, at_most: 100}, steps: [{subcycle: {count: " +
           std::to_string(count) + ", steps: [{solve: [pore], stabilize: fixed_stress}]}}, {solve: [rock]}]}}]";
  };
  SceneRun plain("verification/mandel.yaml", {{"schedule", fixed_stress_mandel}, {"time.end", "3237 s"}});
  SceneRun one("verification/mandel.yaml", {{"schedule", subcycled(1)}, {"time.end", "3237 s"}});
  plain.run();
  one.run();
  expect_same_fields(plain, one, 1e-9);
}

TEST(Schemes, SubstepsConserveFluidAndConvergeToSmallSteps) {
  // Flow in four substeps of dt = 0.005 s, the rock once a step: fluid is conserved, and the answer comes near to that
  // of small monolithic steps as dt falls.
  const auto error = [](double dt) {
    const std::vector<Override> stiff = {{"components.pore.storage", "4 1/Pa"}, {"time.end", "0.04 s"}};
    std::vector<Override> small = stiff, cycled = stiff;
    small.push_back({"time.step", "0.00025 s"});
    cycled.push_back({"time.step", std::to_string(dt) + " s"});
    cycled.push_back({"schedule", "[{subcycle: {count: 4, steps: [{solve: pore}]}}, {solve: rock}]"});
    SceneRun reference("verification/terzaghi.yaml", small), run("verification/terzaghi.yaml", cycled);
    reference.run();
    run.run();
    EXPECT_LE(std::abs(run.quantity("fluid_balance_error")), 1e-12 * run.quantity("fluid_outflow"));
    return (run.field("pore.pressure") - reference.field("pore.pressure")).norm();
  };
  EXPECT_LT(error(0.002), 0.6 * error(0.004));
}

TEST(Steps, RepeatedAfterRewindGivesTheSameBits) {
  for (const char* schedule : {"[{solve: [pore, rock, conduit, contact]}]", fixed_stress_onset}) {
    SceneRun run("paper/onset_coarse.yaml", small_onset({{"schedule", schedule}}));
    run.run_until(8 * 3600);
    const StepTime step{8 * 3600, 1800, 8.5 * 3600};
    std::vector<Vector> first;
    ASSERT_TRUE(run.model().attempt(step).converged);
    for (const auto& field : run.model().fields().all()) first.push_back(field->now());
    run.model().rewind();
    ASSERT_TRUE(run.model().attempt({8 * 3600, 60, 8 * 3600 + 60}).converged);  // another step in between
    run.model().rewind();
    ASSERT_TRUE(run.model().attempt(step).converged);
    std::size_t i = 0;
    for (const auto& field : run.model().fields().all()) EXPECT_TRUE(field->now() == first[i++]) << field->name();
  }
}

TEST(Steps, InjectionConservesFluidToRoundOff) {
  SceneRun run("paper/onset_coarse.yaml", small_onset());
  run.run_until(30 * 3600, [&] {
    const double injected = 5e-9 * (std::min(std::max(run.time() - 6 * 3600, 0.0), 15 * 3600.0));
    EXPECT_NEAR(run.quantity("fluid_injected"), injected, 1e-12 * 2.7e-4);
    EXPECT_LE(std::abs(run.quantity("fluid_balance_error")), 1e-9 * 2.7e-4) << run.time();
  });
}

TEST(Steps, NothingExistsThatASceneDoesNotName) {
  SceneRun mechanics = SceneRun::from_text(
      "{geometry: {box: {x: [0, 1], y: [0, 1]}}, mesh: {size: 0.2}, components: {rock: {type: poromechanics/mpsa, "
      "young_modulus: 1 Pa, poisson_ratio: 0.2, boundary: {left: {displacement_x: 0}, bottom: {displacement_y: 0}, "
      "top: "
      "{normal_stress: -1 Pa}}}}, schedule: [{solve: rock}], time: {end: 1 s, step: 1 s}}");
  ASSERT_TRUE(mechanics.step());
  EXPECT_EQ(mechanics.model().fields().all().size(), 1u);
  EXPECT_EQ(mechanics.linear_counts().factorizations, 1);
  SceneRun flow = SceneRun::from_text(
      "{geometry: {box: {x: [0, 1], y: [0, 1]}}, mesh: {size: 0.2}, components: {pore: {type: matrix_flow/tpfa, "
      "permeability: 1 m^2, viscosity: 1 Pa*s, storage: 1 1/Pa, boundary: {left: {pressure: 1 Pa}}}}, schedule: "
      "[{solve: pore}], time: "
      "{end: 4 s, step: 1 s}}");
  flow.run();
  for (const auto& field : flow.model().fields().all()) EXPECT_EQ(field->spec().owner, "pore");
  EXPECT_EQ(flow.linear_counts().factorizations, 1);
}

}  // namespace
}  // namespace sprekk::testing
