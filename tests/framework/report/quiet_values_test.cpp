#include "framework/report/quiet_values.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace sprekk {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

QuietValues beside(const std::string& unit, double largest) {
  SizesOfUnits sizes;
  sizes.add(unit, {0, -largest, nothing});
  return QuietValues(sizes);
}

TEST(QuietValues, are_those_that_do_not_change) {
  QuietValues quiet = beside("Pa", 1e6);
  EXPECT_TRUE(quiet.take("held", "Pa", {nothing, 2e6, 2e6}));
  EXPECT_TRUE(quiet.take("none", "1", {0, 0}));
  EXPECT_FALSE(quiet.take("rises", "Pa", {2e6, 2.00001e6}));
  EXPECT_FALSE(quiet.take("without", "Pa", {nothing}));
  EXPECT_EQ(quiet.told(), "<p>Not drawn, since constant: held 2 MPa, none 0.</p>\n");
}

TEST(QuietValues, are_far_below_others_of_their_unit) {
  QuietValues quiet = beside("m", 1e-3);
  EXPECT_TRUE(quiet.take("slip", "m", {1e-15, -3e-15}));
  EXPECT_FALSE(quiet.take("opening", "m", {1e-12, 2e-12}));
  EXPECT_FALSE(quiet.take("flux", "m/s", {1e-15, 3e-15}));
  EXPECT_NE(quiet.told().find("slip, at most 3e-06 nm"), std::string::npos) << quiet.told();
}

}  // namespace
}  // namespace sprekk
