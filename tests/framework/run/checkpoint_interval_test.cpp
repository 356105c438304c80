#include "framework/run/checkpoint_interval.hpp"

#include <gtest/gtest.h>

namespace sprekk {
namespace {

TEST(CheckpointInterval, BeginsWithAMinuteAndEndsWithTen) {
  EXPECT_DOUBLE_EQ(checkpoint_interval(std::nullopt, 0, 0), 60);
  EXPECT_DOUBLE_EQ(checkpoint_interval(std::nullopt, 1200, 0), 60);
  EXPECT_DOUBLE_EQ(checkpoint_interval(std::nullopt, 6000, 0), 300);
  EXPECT_DOUBLE_EQ(checkpoint_interval(std::nullopt, 1e6, 0), 600);
}

TEST(CheckpointInterval, LeavesNineteenTwentiethsOfTheTimeToTheRun) {
  EXPECT_DOUBLE_EQ(checkpoint_interval(std::nullopt, 0, 10), 200);
  EXPECT_DOUBLE_EQ(checkpoint_interval(std::nullopt, 1e6, 60), 1200);
}

TEST(CheckpointInterval, IsWhatTheUserAsksFor) { EXPECT_DOUBLE_EQ(checkpoint_interval(5.0, 1e6, 60), 5); }

}  // namespace
}  // namespace sprekk
