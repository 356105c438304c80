#include "framework/mesh/medium.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>

namespace sprekk {
namespace {

TEST(Medium, IsNeutralWithoutPhysics) { EXPECT_EQ(medium_name(), "medium"); }

/// Names ice and salt, and whether all is as it should be.
bool salt_is_refused() {
  const RegisterMedium ice("ice"), again("ice");
  try {
    const RegisterMedium salt("salt");
    return false;
  } catch (const std::logic_error&) {
    return medium_name() == "ice";
  }
}

TEST(Medium, HasOneName) {
  // In a process of its own: the name stays.
  EXPECT_EXIT(std::exit(salt_is_refused() ? 0 : 1), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace sprekk
