#include <gtest/gtest.h>

#include "framework/config/input_error.hpp"

namespace sprekk {
namespace {

struct Case {
  const char* word;
  const char* nearest;
};

class NearestName : public testing::TestWithParam<Case> {};

TEST_P(NearestName, is_found) {
  const std::vector<std::string> names = {"permeability", "porosity", "viscosity", "MPa", "mPa", "x", "young_modulus"};
  EXPECT_EQ(nearest_name(GetParam().word, names), GetParam().nearest);
}

INSTANTIATE_TEST_SUITE_P(all, NearestName,
                         testing::Values(Case{"permeabilty", "permeability"}, Case{"prorosity", "porosity"},
                                         Case{"viscosiyt", "viscosity"},  // neighbours swapped
                                         Case{"young-modulus", "young_modulus"}, Case{"perm", "permeability"},
                                         Case{"Mpa", "MPa"}, Case{"mpa", "mPa"}, Case{"POROSITY", "porosity"},
                                         Case{"temperature", ""}, Case{"q", ""}, Case{"", ""}));

TEST(NearestName, none_of_a_huge_word) { EXPECT_EQ(nearest_name(std::string(1'000'000, 'a'), {"aa"}), ""); }

TEST(NearestName, none_when_two_begin_so) { EXPECT_EQ(nearest_name("bou", {"boundary", "bounded_values"}), ""); }

}  // namespace
}  // namespace sprekk
