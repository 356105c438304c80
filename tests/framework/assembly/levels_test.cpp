#include "framework/assembly/levels.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/field/field_store.hpp"

namespace sprekk {
namespace {

class LevelsOfPressures : public ::testing::Test {
 protected:
  Field& add(const std::string& owner) {
    return fields_.add(mesh_, {.owner = owner,
                               .name = "pressure",
                               .location = Location::cell,
                               .role = Role::unknown(BlockKind::interface),
                               .unit = "Pa",
                               .doc = "A pressure"});
  }
  void float_(const Field& field) { levels_.floats(field, {"scene.yaml", 3, 1}, "nothing holds it", "hold it"); }

  Mesh mesh_;
  FieldStore fields_;
  Field &rock_ = add("rock"), &fracture_ = add("fracture"), &other_ = add("other");
  Levels levels_;
};

TEST_F(LevelsOfPressures, AreHeldWhenNobodySaysOtherwise) { EXPECT_NO_THROW(levels_.require_held()); }

TEST_F(LevelsOfPressures, AreMissedWithTheReason) {
  float_(rock_);
  try {
    levels_.require_held();
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "scene.yaml:3:1: the level of rock.pressure is not determined (nothing holds it) hold it");
  }
}

TEST_F(LevelsOfPressures, AreHeldByCouplers) {
  float_(rock_);
  levels_.hold(rock_);
  EXPECT_NO_THROW(levels_.require_held());
}

TEST_F(LevelsOfPressures, AreHeldThroughAChainOfTies) {
  float_(rock_);
  float_(fracture_);
  levels_.tie(rock_, fracture_);
  EXPECT_THROW(levels_.require_held(), InputError);
  levels_.tie(fracture_, other_);
  EXPECT_NO_THROW(levels_.require_held());
}

}  // namespace
}  // namespace sprekk
