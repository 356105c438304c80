#include <gtest/gtest.h>

#include "framework/config/input_error.hpp"
#include "framework/config/unknown_key.hpp"

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

TEST(NameAdvice, SuggestsNamesOfWhichTheWordIsAPart) {
  const std::vector<std::string> names = {"matrix_flow/mpfa", "matrix_flow/tpfa", "fluid_density", "rock_density",
                                          "friction"};
  EXPECT_EQ(name_advice("mpfa", names, ""), "did you mean 'matrix_flow/mpfa'?");
  EXPECT_EQ(name_advice("density", names, ""), "did you mean 'fluid_density' or 'rock_density'?");
  EXPECT_EQ(name_advice("friction_angle", names, ""), "did you mean 'friction'?");
  EXPECT_EQ(name_advice("temperature", names, ""), "");
  EXPECT_EQ(name_advice("mpfa", names, "it belongs elsewhere"),
            "did you mean 'matrix_flow/mpfa'? it belongs elsewhere");
}

TEST(NearestName, none_of_a_huge_word) { EXPECT_EQ(nearest_name(std::string(1'000'000, 'a'), {"aa"}), ""); }

TEST(NearestName, none_when_two_begin_so) { EXPECT_EQ(nearest_name("bou", {"boundary", "bounded_values"}), ""); }

}  // namespace
}  // namespace sprekk
