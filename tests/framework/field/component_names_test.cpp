#include "framework/field/component_names.hpp"

#include <gtest/gtest.h>

namespace sprekk {
namespace {

using Names = std::vector<std::string>;

TEST(ComponentNames, FollowFromTheNumberOfComponents) {
  EXPECT_EQ(component_names(1), Names{});
  if constexpr (dimension == 2) {
    EXPECT_EQ(component_names(2), (Names{"x", "y"}));
    EXPECT_EQ(component_names(3), (Names{"xx", "yy", "xy"}));
    EXPECT_EQ(component_names_on_fractures(2), (Names{"n", "t"}));
  } else {
    EXPECT_EQ(component_names(3), (Names{"x", "y", "z"}));
    EXPECT_EQ(component_names(6), (Names{"xx", "yy", "zz", "xy", "xz", "yz"}));
  }
  EXPECT_EQ(component_names(5), (Names{"1", "2", "3", "4", "5"}));
}

}  // namespace
}  // namespace sprekk
