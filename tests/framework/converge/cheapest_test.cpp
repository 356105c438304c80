#include "framework/converge/cheapest.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sprekk {
namespace {

TEST(Cheapest, is_good_enough_and_nothing_cheaper_is) {
  const auto value = [](double h, double t) { return 1 + 0.1 * h * h + 0.05 * t; };
  const ValueError error =
      value_error({value(2, 1), value(1, 2)}, {value(0.5, 1), value(1, 0.5)}, value(1, 1), value(0.5, 0.5));
  CostModel cost;
  cost.add(4);
  cost.add(2);
  for (const double wanted : {0.2, 0.05, 0.01}) {
    const auto found = cheapest_factors({error}, {wanted}, cost);
    ASSERT_TRUE(found);
    EXPECT_LE(std::abs(value((*found)[0], (*found)[1]) - 1), wanted);
    EXPECT_LE(error.stated(*found), wanted);
    for (const double h : {1 / std::sqrt(2), 1.0, std::sqrt(2)})
      for (const double t : {1 / std::sqrt(2), 1.0, std::sqrt(2)}) {
        const std::vector<double> near = {(*found)[0] * h, (*found)[1] * t};
        const bool is_tried = near[0] < 2.1 && near[1] < 2.1;
        if (is_tried && error.stated(near) <= wanted) {
          EXPECT_GE(cost.of(near), cost.of(*found) * (1 - 1e-12));
        }
      }
  }
  EXPECT_FALSE(cheapest_factors({error}, {1e-9}, cost));
}

}  // namespace
}  // namespace sprekk
