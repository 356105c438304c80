#include "components/fine_fracture/quarter_point/elasticity/auxiliary_field.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/components/fine_fracture/quarter_point/cases.hpp"

namespace sprekk::test {
namespace {

/// Both ways are exact, so they differ by round-off of the size of the field at this distance; parts of the field
/// vanish at the walls.
TEST(AuxiliaryField, TogetherIsAsOneByOne) {
  constexpr std::array fields = {Auxiliary::opening, Auxiliary::sliding, Auxiliary::force};
  constexpr double rounding = 1e-14;
  for (const double r : {1e-6, 0.02, 3.0}) {
    for (const double theta : {-3.14159, -3.0, -1.6, -1.5, -0.3, -1e-9, 0.0, 1e-5, 0.8, 1.57, 1.58, 2.9, 3.14159}) {
      const auto all = auxiliary_points(table_1_rock, r * Point(std::cos(theta), std::sin(theta)));
      for (std::size_t f = 0; f < fields.size(); ++f) {
        const AuxiliaryPoint one = auxiliary_point(fields[f], table_1_rock, r, theta);
        const AuxiliaryPoint scale = auxiliary_point(fields[f], table_1_rock, r, 1);
        EXPECT_LT((all[f].stress - one.stress).norm(), rounding * scale.stress.norm()) << r << ' ' << theta;
        EXPECT_LT((all[f].displacement_along - one.displacement_along).norm(),
                  rounding * scale.displacement_along.norm())
            << r << ' ' << theta;
        EXPECT_LT((all[f].strain_along - one.strain_along).norm(), rounding * scale.strain_along.norm())
            << r << ' ' << theta;
      }
    }
  }
}

}  // namespace
}  // namespace sprekk::test
