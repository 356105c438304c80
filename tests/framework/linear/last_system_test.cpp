// What has changed since the last system, by numbers and bit by bit.
#include "framework/linear/last_system.hpp"

#include <gtest/gtest.h>

#include "tests/framework/linear/test_systems.hpp"

namespace sprekk {
namespace {

LinearSystem numbered(LinearSystem system, std::uint64_t pattern, std::uint64_t number) {
  system.pattern_number = pattern;
  system.number = number;
  return system;
}

const LinearSystem first = test::poisson(4);
LinearSystem other_values() {
  LinearSystem system = first;
  system.local.coeffRef(3, 3) *= 1 + 1e-15;
  return system;
}

TEST(LastSystem, ComparesBits) {
  LastSystem last;
  EXPECT_EQ(last.compare_and_remember(first), Change::pattern);
  EXPECT_EQ(last.compare_and_remember(first), Change::nothing);
  EXPECT_EQ(last.compare_and_remember(other_values()), Change::values);
  EXPECT_EQ(last.compare_and_remember(test::poisson(5)), Change::pattern);
  last.forget();
  EXPECT_EQ(last.compare_and_remember(test::poisson(5)), Change::pattern);
}

// Numbers that do not tell systems apart: another one says nothing.
TEST(LastSystem, TakesOneNumberForOneSystem) {
  LastSystem last;
  last.compare_and_remember(numbered(first, 1, 1));
  EXPECT_EQ(last.compare_and_remember(numbered(first, 2, 2)), Change::nothing);
  EXPECT_EQ(last.compare_and_remember(numbered(other_values(), 2, 2)), Change::nothing);
  EXPECT_EQ(last.compare_and_remember(numbered(other_values(), 2, 3)), Change::values);
}

TEST(LastSystem, BelievesNumbersThatTellApart) {
  const std::uint64_t one = new_telling_number(), other = new_telling_number();
  LastSystem last;
  EXPECT_EQ(last.compare_and_remember(numbered(first, 1, one)), Change::pattern);
  EXPECT_EQ(last.compare_and_remember(numbered(first, 1, one)), Change::nothing);
  EXPECT_EQ(last.compare_and_remember(numbered(first, 1, other)), Change::values);
  EXPECT_EQ(last.compare_and_remember(numbered(first, 3, one)), Change::pattern);
}

// Without such numbers bits are compared after all, with a system of which there is a copy.
TEST(LastSystem, ComparesAgainWhereNumbersEnd) {
  LastSystem last;
  last.compare_and_remember(numbered(first, 1, new_telling_number()));
  EXPECT_EQ(last.compare_and_remember(numbered(first, 0, 0)), Change::pattern);
  EXPECT_EQ(last.compare_and_remember(numbered(first, 0, 0)), Change::nothing);
  EXPECT_EQ(last.compare_and_remember(numbered(other_values(), 0, 0)), Change::values);
  EXPECT_EQ(last.compare_and_remember(numbered(other_values(), 1, new_telling_number())), Change::pattern);
  EXPECT_EQ(last.compare_and_remember(numbered(first, 1, 2)), Change::values);
  EXPECT_EQ(last.compare_and_remember(numbered(first, 0, 0)), Change::nothing);
}

TEST(LastSystem, SeesStabilizations) {
  LinearSystem stabilized = first;
  stabilized.blocks[0].stabilization = Vector::Ones(16);
  EXPECT_TRUE(have_same_places(first, stabilized));
  EXPECT_FALSE(have_same_bits(first, stabilized));
  EXPECT_TRUE(have_same_bits(stabilized, stabilized));
  LastSystem last;
  last.compare_and_remember(first);
  EXPECT_EQ(last.compare_and_remember(stabilized), Change::values);
  EXPECT_EQ(last.compare_and_remember(stabilized), Change::nothing);
}

}  // namespace
}  // namespace sprekk
