#include "framework/scene/lost_amounts.hpp"

#include <gtest/gtest.h>

namespace sprekk {
namespace {

using Balances = std::map<std::string, Balance>;

Balances fluid(double stored, double injected, double outflow, bool is_closed = true) {
  return {{"fluid", {stored, injected, outflow, stored + injected + outflow, "m^2", is_closed}}};
}

/// The totals at the start are 3 stored, 5 injected, 2 let out.
std::string lost(const Balances& after, StepAmounts amounts = {}, double tolerance = 1e-8) {
  return find_lost_amounts(fluid(3, 5, 2), after, tolerance, [&](const std::string&) { return amounts; });
}

TEST(LostAmounts, AreThoseBeyondTheToleranceOfWhatWasMoved) {
  for (const double error : {1.1e-8, -1.1e-8, 0.9e-8, -0.9e-8}) {
    EXPECT_EQ(lost(fluid(4 + 2 * error, 7, 3)).empty(), std::abs(error) < 1e-8) << error;
    EXPECT_EQ(lost(fluid(4, 7 + 2 * error, 3)).empty(), std::abs(error) < 1e-8) << error;
    EXPECT_TRUE(lost(fluid(4 + 2 * error, 7, 3), {}, 1e-7).empty());
  }
}

TEST(LostAmounts, AreComparedWithWhatIsMovedPlaceByPlace) {
  // What leaves one place and enters another is in no total.
  EXPECT_FALSE(lost(fluid(3 + 1e-3, 5, 2)).empty());
  EXPECT_FALSE(lost(fluid(3 + 1e-3, 5, 2), {.moved = 0.9e5}).empty());
  EXPECT_TRUE(lost(fluid(3 + 1e-3, 5, 2), {.moved = 1.1e5}).empty());
}

TEST(LostAmounts, AreNoRoundOff) {
  EXPECT_FALSE(lost(fluid(3 + 1e-3, 5, 2), {.round_off = 0.9e-3}).empty());
  EXPECT_TRUE(lost(fluid(3 + 1e-3, 5, 2), {.round_off = 1.1e-3}).empty());
  EXPECT_TRUE(lost(fluid(3 + 1e-14, 5, 2)).empty());  // of the totals
}

TEST(LostAmounts, AreUnknownWhereValuesArePrescribed) { EXPECT_TRUE(lost(fluid(4, 5, 2, false)).empty()); }

TEST(LostAmounts, AreToldWithTheirSize) {
  const std::string text = lost(fluid(4, 7, 2));
  EXPECT_NE(text.find("the balance of fluid is off by 1 m^2, 0.5 of what was moved in the step"), std::string::npos)
      << text;
}

}  // namespace
}  // namespace sprekk
