#include "components/fine_fracture/growth/growth_options.hpp"
#include "framework/config/yaml/parse_yaml.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sprekk::fine_fracture {
namespace {

GrowthOptions read(const std::string& yaml) {
  GrowthOptions options;
  options.spec().read(parse_yaml(yaml, "growth.yaml"), {});
  return options;
}

TEST(GrowthOptions, only_the_increment_is_required) {
  const GrowthOptions options = read("increment: 20 mm");
  EXPECT_DOUBLE_EQ(options.increment, 0.02);
  EXPECT_TRUE(options.is_implicit());
  EXPECT_TRUE(options.seeks_arrest());
  EXPECT_EQ(options.energy_exponent, 0.35);
  EXPECT_FALSE(options.longest);
  EXPECT_THROW(read("direction: explicit"), InputError);
}

TEST(GrowthOptions, refuses_what_makes_no_sense) {
  EXPECT_THROW(read("increment: 0 m"), InputError);
  EXPECT_THROW(read("increment: 3 Pa"), InputError);
  EXPECT_THROW(read("{increment: 1 mm, relaxation: 1.5}"), InputError);
  EXPECT_THROW(read("{increment: 1 mm, direction: sideways}"), InputError);
  EXPECT_THROW(read("{increment: 1 mm, largest_turn: 120 deg}"), InputError);
  EXPECT_DOUBLE_EQ(read("{increment: 1 mm, longest: 3 cm, length: fixed}").longest.value(), 0.03);
}

}  // namespace
}  // namespace sprekk::fine_fracture
