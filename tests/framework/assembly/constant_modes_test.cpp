#include "framework/assembly/constant_modes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/field/field_store.hpp"

namespace sprekk {
namespace {

class ConstantModesOfPressures : public ::testing::Test {
 protected:
  Field& add(const std::string& owner) {
    return fields_.add(mesh_, {.owner = owner,
                               .name = "pressure",
                               .location = Location::cell,
                               .role = Role::unknown(BlockKind::interface),
                               .unit = "Pa",
                               .doc = "A pressure"});
  }
  void float_(const Field& field) { modes_.floats(field, {"scene.yaml", 3, 1}, "nothing holds it", "hold it"); }

  Mesh mesh_;
  FieldStore fields_;
  Field &rock_ = add("rock"), &fracture_ = add("fracture"), &other_ = add("other");
  ConstantModes modes_;
};

TEST_F(ConstantModesOfPressures, AreHeldWhenNobodySaysOtherwise) { EXPECT_NO_THROW(modes_.require_held()); }

TEST_F(ConstantModesOfPressures, AreMissedWithTheReason) {
  float_(rock_);
  try {
    modes_.require_held();
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "scene.yaml:3:1: the constant mode of rock.pressure is not determined (nothing holds it) hold it");
  }
}

TEST_F(ConstantModesOfPressures, AreHeldByCouplers) {
  float_(rock_);
  modes_.hold(rock_);
  EXPECT_NO_THROW(modes_.require_held());
}

TEST_F(ConstantModesOfPressures, AreHeldThroughAChainOfTies) {
  float_(rock_);
  float_(fracture_);
  modes_.tie(rock_, fracture_);
  EXPECT_THROW(modes_.require_held(), InputError);
  modes_.tie(fracture_, other_);
  EXPECT_NO_THROW(modes_.require_held());
}

}  // namespace
}  // namespace sprekk
