// Rock whose properties change with time, alone and with fluid in its pores.
#include <gtest/gtest.h>

#include <cmath>

#include "framework/assembly/counts_work.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

constexpr double hour = 3600, load = 10e6;

std::string column(const std::string& components, const std::string& couplers, const std::string& solve) {
  return "{geometry: {box: {x: [0 m, 1 m], y: [0 m, 2 m]}}, mesh: {size: 0.4 m}, components: {" + components +
         "rock: {type: poromechanics/mpsa, young_modulus: (10e9*(1 - t/(10*h))) Pa, poisson_ratio: 0.2 + 0.01*t/h, "
         "boundary: {left: {displacement_x: 0 m}, right: {displacement_x: 0 m}, bottom: {displacement_y: 0 m}, top: "
         "{normal_stress: -10 MPa}}}}, couplers: [" +
         couplers + "], schedule: [{solve: " + solve + "}], time: {end: 4 h, step: 1 h}}";
}

struct Moduli {
  double oedometric, bulk;
};
Moduli moduli(double t) {
  const double young = 10e9 * (1 - t / (10 * hour)), nu = 0.2 + 0.01 * t / hour;
  return {young * (1 - nu) / ((1 + nu) * (1 - 2 * nu)), young / (3 * (1 - 2 * nu))};
}

long count(SceneRun& run, const std::string& name) {
  for (const auto* part : parts_with<CountsWork>(run.model().parts()))
    if (const auto counts = part->counts(); counts.count(name)) return counts.at(name);
  return 0;
}

void expect_strain(const SceneRun& run, double strain) {
  for (int c = 0; c < run.mesh().cell_count(); ++c) {
    EXPECT_NEAR(run.field("rock.displacement")[2 * c], 0, 1e-10 * std::abs(strain));
    EXPECT_NEAR(run.field("rock.displacement")[2 * c + 1], strain * run.mesh().cell_center[c][1],
                1e-9 * std::abs(strain));
  }
}

/// Under a constant load the strain is load/M(t), whatever the rock was before.
TEST(RockInTime, ColumnShortensAsItSoftens) {
  SceneRun run = SceneRun::from_text(column("", "", "rock"));
  run.run_until(4 * hour, [&] { expect_strain(run, -load / moduli(run.time()).oedometric); });
  EXPECT_EQ(run.steps(), 4);
  EXPECT_EQ(count(run, "stress discretizations"), 4);
  EXPECT_EQ(run.linear_counts().factorizations, 4);
}

/// The same where the rock is given by its stiffness, xxyy = lambda = 4 GPa and a shear modulus of 4 GPa.
TEST(RockInTime, StiffnessOfAnisotropicRockChangesToo) {
  std::string scene = column("", "", "rock");
  const std::string moduli = "young_modulus: (10e9*(1 - t/(10*h))) Pa, poisson_ratio: 0.2 + 0.01*t/h";
  scene.replace(
      scene.find(moduli), moduli.size(),
      "stiffness: {xxxx: (12e9*(1 - t/(10*h))) Pa, yyyy: (12e9*(1 - t/(10*h))) Pa, xyxy: 4 GPa, xxyy: 4 GPa}");
  SceneRun run = SceneRun::from_text(scene);
  run.run_until(4 * hour, [&] { expect_strain(run, -load / (12e9 * (1 - run.time() / (10 * hour)))); });
}

/// A column that lets no fluid out: uniform strain e and pressure p, from one step to the next
///   M e − alpha p = −load,   alpha (e − e_old) + (phi c + (alpha − phi)/K) (p − p_old) = 0,
/// with all properties at the end of the step.
TEST(RockInTime, UndrainedColumnFollowsItsProperties) {
  SceneRun run = SceneRun::from_text(
      column("pore: {type: matrix_flow/mpfa, permeability: 0 m^2, viscosity: 1 mPa*s, porosity: 0.1 + 0.01*t/h, "
             "fluid_compressibility: (4e-10*(1 + t/(10*h))) 1/Pa}, ",
             "{type: biot, between: [pore, rock], biot_coefficient: 0.6 + 0.05*t/h}", "[pore, rock]"));
  double strain = 0, pressure = 0;
  run.run_until(4 * hour, [&] {
    const double t = run.time() / hour, alpha = 0.6 + 0.05 * t, phi = 0.1 + 0.01 * t;
    const auto [oedometric, bulk] = moduli(run.time());
    const double storage = phi * 4e-10 * (1 + t / 10) + (alpha - phi) / bulk;
    const double change =
        alpha * ((load - alpha * pressure) / oedometric + strain) / (storage + alpha * alpha / oedometric);
    pressure += change;
    strain = (alpha * pressure - load) / oedometric;
    for (const double p : run.field("pore.pressure")) EXPECT_NEAR(p, pressure, 1e-9 * load) << run.time();
    expect_strain(run, strain);
  });
  EXPECT_EQ(count(run, "stress discretizations"), 4);
  EXPECT_EQ(count(run, "flux discretizations"), 0);
}

/// A change of alpha alone leaves the discretization as it is.
TEST(RockInTime, BiotCoefficientNeedsNoDiscretization) {
  SceneRun run("verification/mandel.yaml",
               {{"mesh.size", "0.2 m"}, {"materials.biot_coefficient", "[{value: 0.8}, {value: 0.1, from: 5395 s}]"}});
  SceneRun constant("verification/mandel.yaml", {{"mesh.size", "0.2 m"}});
  run.run();
  constant.run();
  EXPECT_EQ(count(run, "stress discretizations"), 1);
  EXPECT_EQ(count(run, "flux discretizations"), 1);
  EXPECT_EQ(run.linear_counts().factorizations, constant.linear_counts().factorizations + 1);
}

TEST(RockInTime, BiotCoefficientThatFallsBelowThePorosityIsRefused) {
  EXPECT_THROW(SceneRun("verification/mandel.yaml", {{"materials.biot_coefficient", "0.8 - 0.795*t/10790"}}),
               InputError);
}

}  // namespace
}  // namespace sprekk::testing
