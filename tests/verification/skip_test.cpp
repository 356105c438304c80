// What a scene does not need is not computed.
#include <gtest/gtest.h>

#include <cmath>

#include "framework/assembly/counts_work.hpp"
#include "framework/config/yaml/load_scene.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

constexpr double hour = 3600;

long count(SceneRun& run, const std::string& name) {
  long sum = 0;
  for (const auto* part : parts_with<CountsWork>(run.model().parts())) {
    const auto counts = part->counts();
    if (const auto found = counts.find(name); found != counts.end()) sum += found->second;
  }
  return sum;
}

/// Section 5.1 of the paper on a coarse mesh, and its rock alone.
std::vector<Override> coarse(const std::vector<Override>& more = {}) {
  std::vector<Override> overrides = {{"mesh", "{size: 0.3 m, fracture_size: 20 mm}"}};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return overrides;
}

std::string unfractured(const std::string& permeability, const std::string& alpha, bool with_flow, bool with_rock) {
  const std::string pore =
      "pore: {type: matrix_flow/mpfa, porosity: 0.01, fluid_compressibility: 4.0e-10 1/Pa, viscosity: "
      "1.0e-4 Pa*s, boundary: {left: {pressure: 1 MPa}}, permeability: " +
      permeability + (alpha == "0" ? ", storage: 4e-11 1/Pa" : "") + "}";
  const std::string rock =
      "rock: {type: poromechanics/mpsa, young_modulus: 40 GPa, poisson_ratio: 0.2, boundary: {left: "
      "{displacement_x: 0 m}, bottom: {displacement_y: 0 m}, right: {normal_stress: -20 MPa}, top: "
      "{normal_stress: -10 MPa}}}";
  const std::string components = with_flow && with_rock ? pore + ", " + rock : with_flow ? pore : rock;
  const std::string solve = with_flow && with_rock ? "[pore, rock]" : with_flow ? "[pore]" : "[rock]";
  return "{geometry: {box: {x: [0 m, 2 m], y: [0 m, 2 m]}}, mesh: {size: 0.3 m}, components: {" + components + "}, " +
         (with_flow && with_rock ? "couplers: [{type: biot, between: [pore, rock], biot_coefficient: " + alpha + "}], "
                                 : "") +
         "schedule: [{solve: " + solve + "}], time: {end: 3 h, step: 1 h}}";
}

TEST(Skip, RockWithoutPermeabilityHasNoFluxAndStaysUndrained) {
  SceneRun run = SceneRun::from_text(unfractured("0 m^2", "0.8", true, true));
  run.run();
  EXPECT_EQ(count(run, "flux discretizations"), 0);
  EXPECT_EQ(count(run, "flux discretizations: cells"), 0);
  EXPECT_EQ(run.linear_counts().factorizations, 1);
  // B (1 + nu_u)/3 (sigma_1 + sigma_2) of Table 1 of the paper, whatever the pressure at a side that lets nothing
  // through.
  for (const double p : run.field("pore.pressure")) EXPECT_NEAR(p, 0.52670 * 1.31043 / 3 * 30e6, 1e-4 * 6.9e6);
}

TEST(Skip, PermeabilityThatIsZeroInPartIsRefused) {
  std::string scene = unfractured("\"if(x > 1, 1e-18, 0) m^2\"", "0.8", true, true);
  EXPECT_THROW(SceneRun::from_text(scene), InputError);
}

TEST(Skip, WallsOfRockWithoutPermeabilityAreRefused) {
  EXPECT_THROW(SceneRun("paper/onset_coarse.yaml", coarse({{"materials.permeability", "0 m^2"}})), InputError);
}

TEST(Skip, WithoutBiotCoefficientFlowAndRockAreTheirOwn) {
  SceneRun both = SceneRun::from_text(unfractured("1e-17 m^2", "0", true, true));
  SceneRun flow = SceneRun::from_text(unfractured("1e-17 m^2", "0", true, false));
  SceneRun rock = SceneRun::from_text(unfractured("1e-17 m^2", "0", false, true));
  for (SceneRun* run : {&both, &flow, &rock}) run->run();
  // The parts are solved for as they would be alone, and the rock not again once it is at rest.
  const LinearCounts of_both = both.linear_counts(), of_flow = flow.linear_counts(), of_rock = rock.linear_counts();
  EXPECT_EQ(of_both.factorizations, of_flow.factorizations + of_rock.factorizations);
  EXPECT_EQ(of_both.solves, of_flow.solves + of_rock.solves);
  const Vector &p = flow.field("pore.pressure"), &u = rock.field("rock.displacement");
  EXPECT_LT((both.field("pore.pressure") - p).lpNorm<Eigen::Infinity>(), 1e-12 * p.lpNorm<Eigen::Infinity>());
  EXPECT_LT((both.field("rock.displacement") - u).lpNorm<Eigen::Infinity>(), 1e-12 * u.lpNorm<Eigen::Infinity>());
}

TEST(Skip, WhereNothingSlipsNoContactIterationIsMade) {
  // tau/N is 1/3 without fluid pressure; at 6.9 MPa it is 0.62, below the friction of 2.
  SceneRun run("paper/onset_coarse.yaml", coarse({{"materials.friction", "2"}}));
  run.run_until(6 * hour, [&] { EXPECT_EQ(run.iterations(), 1) << run.time(); });
  EXPECT_EQ(run.quantity("contact.cells_stick"), run.mesh().fracture_cell_count());
  EXPECT_EQ(run.linear_counts().factorizations, 1);
}

TEST(Skip, FractureThatSlipsTakesOneFactorization) {
  SceneRun run("paper/onset_coarse.yaml", coarse());
  run.run_until(6 * hour);
  EXPECT_GT(std::abs(run.quantity("slip.t")), 1e-6);
  EXPECT_EQ(run.linear_counts().factorizations, 1);
}

TEST(Skip, InputsThatStayAreDiscretizedOnce) {
  SceneRun run("paper/onset_coarse.yaml", coarse());
  run.run_until(8 * hour);
  EXPECT_EQ(count(run, "flux discretizations"), 1);
  EXPECT_EQ(count(run, "stress discretizations"), 1);
  EXPECT_EQ(count(run, "stress discretizations: cells"), run.mesh().cell_count());
}

/// Only around the cells whose properties change; with the bits of operators that are made as a whole.
TEST(Skip, PropertiesThatChangeInOneRegionAreDiscretizedThere) {
  const auto scene = [](const std::string& time) {
    return "{geometry: {box: {x: [0 m, 2 m], y: [0 m, 2 m]}, regions: {plug: {polygon: [[0 m, 0 m], [0.5 m, 0 m], [0.5 "
           "m, 0.5 m], [0 m, 0.5 m]]}}}, mesh: {size: 0.2 m}, components: {pore: {type: matrix_flow/mpfa, storage: "
           "4e-11 1/Pa, viscosity: 1.0e-4 Pa*s, boundary: {left: {pressure: 1 MPa}}, permeability: {regions: {plug: "
           "\"(1e-17*(1 + t/h)) m^2\", default: 1e-17 m^2}}}, rock: {type: poromechanics/mpsa, young_modulus: "
           "{regions: {plug: \"(1e10*(1 + t/h)) Pa\", default: 10 GPa}}, poisson_ratio: 0.2, boundary: {left: "
           "{displacement_x: 0 m}, bottom: {displacement_y: 0 m}, right: {normal_stress: -20 MPa}}}}, couplers: "
           "[{type: "
           "biot, between: [pore, rock], biot_coefficient: 0.8}], schedule: [{solve: [pore, rock]}], time: {" +
           time + "}}";
  };
  SceneRun run = SceneRun::from_text(scene("end: 2 h, step: 1 h"));
  run.run();
  for (const std::string name : {"flux discretizations", "stress discretizations"}) {
    EXPECT_EQ(count(run, name), 2);
    EXPECT_LT(count(run, name + ": cells"), 1.3 * run.mesh().cell_count());
  }
  SceneRun whole = SceneRun::from_text(scene("start: 1 h, end: 2 h, step: 1 h"));
  for (SceneRun* each : {&run, &whole}) {
    each->model().fields().at("pore.pressure").set_both(Vector::Constant(each->mesh().cell_count(), 1e5));
    for (const auto& field : each->model().fields().all())
      if (field->name() != "pore.pressure") field->set_both(Vector::Zero(field->size()));
    ASSERT_TRUE(each->model().attempt({hour, hour, 2 * hour}).converged);
  }
  for (const auto& field : run.model().fields().all())
    EXPECT_EQ(field->now(), whole.field(field->name())) << field->name();
}

TEST(Skip, TipsFarFromGrowthHaveNoFineLevel) {
  SceneRun run("paper/onset.yaml", coarse({{"components.tips.toughness", "100 MPa*m^0.5"}}));
  run.run_until(8 * hour);
  EXPECT_EQ(count(run, "tips: solves"), 0);
  EXPECT_EQ(count(run, "tips: meshes"), 0);
  EXPECT_EQ(count(run, "tips: ruled out"), 16);  // two tips, eight steps
}

}  // namespace
}  // namespace sprekk::testing
