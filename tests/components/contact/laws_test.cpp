// The laws of contact: their own functions against published ones, and the whole Jacobian against differences.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "components/contact/laws/closure.hpp"
#include "tests/components/contact/contact_alone.hpp"

namespace sprekk::contact {
namespace {

TEST(Closure, OfBartonBandisInvertsThePublishedLaw) {
  ClosureOptions options;
  options.law = "barton_bandis";
  options.stiffness = 3e11;
  options.largest = 2e-5;
  const auto law = options.build();
  for (const double pressure : {0.0, 1e3, 1e6, 3e7, 1e12}) {
    const double c = law->at(pressure).closure;
    // sigma = k_ni c/(1 − c/V_m), Bandis and others 1983.
    EXPECT_NEAR(3e11 * c / (1 - c / 2e-5), pressure, 1e-9 * pressure);
    EXPECT_LE(c, 2e-5);
    const double step = 1e-4 * std::max(pressure, 1e3);
    EXPECT_NEAR((law->at(pressure + step).closure - law->at(pressure).closure) / step,
                law->at(pressure + step / 2).by_pressure, 1e-6 * law->at(pressure).by_pressure);
  }
  EXPECT_NEAR(law->at(1e12).closure / 2e-5, 1, 1e-5);
  EXPECT_EQ(law->at(-1e3).closure, -1e3 / 3e11);  // goes on linearly
}

TEST(Weakening, IsLinearAndEnds) {
  const Weakening law{2e-3, 4e6, 1e6};
  EXPECT_DOUBLE_EQ(law.at(0.6, 0.2, 0).friction, 0.6);
  EXPECT_DOUBLE_EQ(law.at(0.6, 0.2, 5e-4).friction, 0.5);
  EXPECT_DOUBLE_EQ(law.at(0.6, 0.2, 5e-4).cohesion, 3e6);
  EXPECT_DOUBLE_EQ(law.at(0.6, 0.2, 1e-3).tension, 5e5);
  EXPECT_DOUBLE_EQ(law.at(0.6, 0.2, 1).friction, 0.2);
  EXPECT_EQ(law.at(0.6, 0.2, 1).cohesion, 0);
  EXPECT_EQ(law.at(0.6, 0.2, 1).friction_by_path, 0);
  EXPECT_EQ(law.at(0.1, 0.2, 1).friction, 0.1);  // below the dynamic friction already
}

TEST(Weakening, WithoutADistanceLosesNothing) {
  const Weakening law{0, 4e6, 0};
  for (const double path : {0.0, 1e-3, 10.0}) {
    const Strength strength = law.at(0.6, 0.2, path);
    EXPECT_EQ(strength.friction, 0.6);
    EXPECT_EQ(strength.cohesion, 4e6);
    EXPECT_EQ(strength.friction_by_path, 0);
    EXPECT_EQ(strength.cohesion_by_path, 0);
  }
}

/// Units of the stiffness of the walls: tractions and jumps of the same size.
Options all_laws() {
  Options options;
  options.closure.law = "barton_bandis";
  options.closure.stiffness = 20;
  options.closure.largest = 0.4;
  options.weakening = {3, 2, 1};
  options.dynamic_friction = 0.2;
  options.dilation_limit = 0.8;
  return options;
}

Options mohr_coulomb() {
  Options options;
  options.weakening.cohesion = 0.5;
  return options;
}

TEST(Laws, HaveTheDerivativesOfTheirConditions) {
  const Mesh mesh = crossing();
  for (const Options& options : {all_laws(), mohr_coulomb()})
    for (const Multiplier multiplier : {Multiplier::present, Multiplier::none}) {
      Contact contact(mesh, {}, options, multiplier);
      const int cells = mesh.fracture_cell_count();
      contact.law().set_wall_stiffness(Vector::LinSpaced(2 * cells, 1, 2));
      std::mt19937 random(5);
      int counts[3] = {0, 0, 0};
      for (int number = 0; number < 20; ++number) {
        SCOPED_TRACE(number);
        const Sample sample(contact, cells, random);
        for (int i = 0; i < cells; ++i) ++counts[static_cast<int>(contact.law().state(i))];
        expect_differences(contact, sample, 1e-6, 1e-7);
      }
      if (multiplier == Multiplier::none) continue;  // whose states depend on jumps only
      for (const int count : counts) EXPECT_GT(count, 10);
    }
}

/// Springs in series with the walls: what a traction moves by them is taken off the jump, d/df = (d/df) − (d/du)/c.
TEST(Laws, OfAnIterateHaveTheDerivativesOfSpringsAndTheirResidualWithoutThem) {
  const Mesh mesh = crossing();
  const int cells = mesh.fracture_cell_count(), n = 2 * cells;
  const Vector stiffness = Vector::LinSpaced(n, 1, 2);
  for (const auto& [law, options] : {std::pair(Law(), all_laws()), std::pair(Law{0.6, 0}, mohr_coulomb())}) {
    Contact springs(mesh, law, options, Multiplier::last), walls(mesh, law, options);
    springs.law().set_wall_stiffness(stiffness);
    walls.law().set_wall_stiffness(stiffness);
    std::mt19937 random(5), again(5);
    for (int number = 0; number < 20; ++number) {
      SCOPED_TRACE(number);
      const Sample sample(springs, cells, random), same(walls, cells, again);
      ASSERT_EQ(sample.traction, same.traction);
      EXPECT_EQ(springs.residual(), walls.residual());
      const Eigen::MatrixXd with = springs.jacobian(), without = walls.jacobian();
      EXPECT_LT((with - without).rightCols(n).lpNorm<Eigen::Infinity>(), 1e-12);
      EXPECT_GT((with - without).leftCols(n).lpNorm<Eigen::Infinity>(), 0.1);
      if (law.dilation_angle > 0) continue;  // where walls open by their slip, without that of the springs
      const Eigen::MatrixXd in_series = -without.rightCols(n) * stiffness.cwiseInverse().asDiagonal();
      EXPECT_LT(((with - without).leftCols(n) - in_series).lpNorm<Eigen::Infinity>(), 1e-12);
    }
  }
}

}  // namespace
}  // namespace sprekk::contact
