// Laws for the hydraulic aperture against their formulas, limits and differences.
#include <gtest/gtest.h>

#include <cmath>

#include "components/fracture_flow/laws/known_laws.hpp"

namespace sprekk::fracture_flow {
namespace {

TEST(HydraulicLaw, cubic_is_the_aperture_and_not_below_the_residual_one) {
  const auto law = make_hydraulic_law("cubic", {1e-6, 0});
  EXPECT_EQ(law->at(3e-4).value, 3e-4);
  EXPECT_EQ(law->at(3e-4).by_aperture, 1);
  for (const double closed : {0.0, -1e-9, 0.9e-6}) {
    EXPECT_EQ(law->at(closed).value, 1e-6);
    EXPECT_EQ(law->at(closed).by_aperture, 0);
  }
}

TEST(HydraulicLaw, rough_walls_conduct_less_by_the_factor_of_lomize) {
  const double height = 4e-5;
  const auto law = make_hydraulic_law("rough", {1e-9, height});
  for (const double ratio : {0.1, 1.0, 4.0, 100.0}) {  // a/e
    const double a = ratio * height;
    EXPECT_NEAR(std::pow(a / law->at(a).value, 3) / (1 + 6 / (ratio * std::sqrt(ratio))), 1, 1e-12) << ratio;
  }
  EXPECT_NEAR(law->at(1e4 * height).value / (1e4 * height), 1, 3e-6);  // smooth where it is wide
  EXPECT_EQ(law->at(0).value, 1e-9);
  EXPECT_EQ(law->at(-1e-5).value, 1e-9);
  EXPECT_EQ(make_hydraulic_law("rough", {1e-9, 0})->at(2e-4).value, 2e-4);
}

TEST(HydraulicLaw, derivatives_are_those_of_the_values) {
  for (const char* name : {"cubic", "rough"}) {
    const auto law = make_hydraulic_law(name, {1e-6, 4e-5});
    for (const double a : {2e-7, 9e-6, 4e-5, 1e-3}) {
      const double by = 1e-6 * a;
      EXPECT_NEAR((law->at(a + by).value - law->at(a - by).value) / (2 * by), law->at(a).by_aperture, 1e-8)
          << name << " " << a;
    }
  }
}

}  // namespace
}  // namespace sprekk::fracture_flow
