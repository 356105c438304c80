// All properties of section 5.1 of the paper change with time: cumulative balances, solvers, schemes and repeated
// steps.
#include <gtest/gtest.h>

#include <cmath>

#include "components/capabilities/poroelastic_rock.hpp"
#include "framework/config/yaml/load_scene.hpp"
#include "tests/verification/same_fields.hpp"

namespace sprekk::testing {
namespace {

constexpr double hour = 3600;

/// On a mesh that a test can afford: 10 cells on the fracture.
std::vector<Override> in_time(const std::vector<Override>& more = {}) {
  std::vector<Override> overrides = {{"mesh.size", "0.25 m"},
                                     {"mesh.fracture_size", "0.01 m"},
                                     {"mesh.growth", "0.3"},
                                     {"materials.young_modulus", "(40e9*(1 - t/(100*h))) Pa"},
                                     {"materials.poisson_ratio", "0.2 + 0.001*t/h"},
                                     {"materials.biot_coefficient", "0.8 - 0.005*t/h"},
                                     {"materials.porosity", "0.01*(1 + 0.02*t/h)"},
                                     {"materials.fluid_compressibility", "(4e-10*(1 + 0.02*t/h)) 1/Pa"},
                                     {"materials.permeability", "(5e-20*(1 + t/h)) m^2"},
                                     {"materials.viscosity", "(1e-4*(1 - 0.01*t/h)) Pa*s"},
                                     {"materials.friction", "0.5 - 0.01*t/h"},
                                     {"materials.dilation_angle", "(1 + 0.05*t/h) deg"},
                                     {"couplers.2.fracture_biot_coefficient", "1 - 0.002*t/h"},
                                     {"components.pore.boundary", "{left: {pressure: 1 MPa}}"}};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return overrides;
}

TEST(PropertiesInTime, FluidIsConserved) {
  SceneRun run("paper/onset_coarse.yaml", in_time());
  run.run_until(12 * hour, [&] {
    double moved = 0;
    for (const char* part : {"fluid_stored", "fluid_injected", "fluid_outflow"}) moved += std::abs(run.quantity(part));
    EXPECT_LT(std::abs(run.quantity("fluid_balance_error")), 1e-9 * moved) << run.time();
  });
  EXPECT_GT(std::abs(run.quantity("slip.t")), 1e-6);
}

TEST(PropertiesInTime, WholeSystemAndSplitSchemeGiveTheSameAnswer) {
  SceneRun run("paper/onset_coarse.yaml", in_time());
  SceneRun whole("paper/onset_coarse.yaml", in_time({{"solver", "{condense: false}"}}));
  SceneRun split("paper/onset_coarse.yaml", in_time({{"schedule",
                                                      "[{iterate: {fallback: none, until: {relative: 1e-11, at_most: "
                                                      "200}, steps: [{solve: [pore, conduit], stabilize: "
                                                      "fixed_stress}, {solve: [rock, contact]}]}}]"}}));
  for (SceneRun* each : {&run, &whole, &split}) each->run_until(9 * hour);
  expect_same_fields(run, whole, 1e-8);
  expect_same_fields(run, split, 1e-8);
}

/// Another attempt in between changes no bit.
TEST(PropertiesInTime, RepeatedStepHasTheSameBits) {
  SceneRun run("paper/onset_coarse.yaml", in_time()), again("paper/onset_coarse.yaml", in_time());
  const StepTime step{0, hour, hour}, shorter{0, 600, 600};
  ASSERT_TRUE(run.model().attempt(step).converged);
  ASSERT_TRUE(again.model().attempt(shorter).converged);
  again.model().rewind();
  ASSERT_TRUE(again.model().attempt(step).converged);
  for (const auto& field : run.model().fields().all())
    EXPECT_EQ(field->now(), again.field(field->name())) << field->name();
}

/// Growth: the mesh changes between two steps, and its cells have the properties of that time. Reference: the same
/// model built anew on that mesh.
TEST(PropertiesInTime, MeshThatGrowsHasThePropertiesOfItsTime) {
  const std::vector<Override> soft = {{"mesh", "{size: 0.5 m, fracture_size: 25 mm}"},
                                      {"components.tips.toughness", "0.42 MPa*m^0.5"},
                                      {"components.tips.size", "0.3 m"},
                                      {"components.tips.sectors", "8"},
                                      {"components.tips.mesh_ratio", "1"},
                                      {"components.tips.growth", "{increment: 5 mm}"},
                                      {"couplers.4.propagation_threshold", "0.2"},
                                      {"schedule.1.update", "after_step"},
                                      {"components.conduit.injection.well.rate", "4.0e-8 m^2/s"},
                                      {"time.step", "10 min"},
                                      {"materials.young_modulus", "(40e9/(1 + t/(20*min))) Pa"},
                                      {"materials.permeability", "(5e-20*(1 + t/min)) m^2"}};
  SceneRun run("paper/wing_cracks.yaml", soft);
  while (run.mesh_changes() == 0 && run.time() < 40) ASSERT_TRUE(run.step());
  ASSERT_GT(run.mesh_changes(), 0);
  Model fresh(run.model().scene(), run.mesh());
  const StepTime step{run.time() - 1, 1, run.time()};
  begin_step(fresh.parts(), step);
  begin_step(run.model().parts(), step);
  const auto walls = [](Model& model) {
    for (Part* part : model.parts())
      if (auto* capable = dynamic_cast<RockWalls*>(part)) return capable->displacement_jump();
    throw std::logic_error("no walls");
  };
  const LinearExpression grown = walls(run.model()), expected = walls(fresh);
  ASSERT_EQ(grown.terms.size(), expected.terms.size());
  for (std::size_t i = 0; i < grown.terms.size(); ++i)
    EXPECT_EQ((grown.terms[i].matrix.entries() - expected.terms[i].matrix.entries()).norm(), 0);
}

}  // namespace
}  // namespace sprekk::testing
