#include "framework/run/output_times.hpp"

#include <gtest/gtest.h>

namespace sprekk {
namespace {

TEST(OutputTimes, AreMultiplesAfterTheStartTheGivenOnesAndTheEnd) {
  Scene scene;
  scene.time.start = -0.5;
  scene.time.end = 1;
  scene.time.step = 0.1;
  scene.output.every = 0.4;
  scene.output.times = {0.25};
  const OutputTimes times(scene);
  for (const double time : {-0.1, 0.3, 0.7, 0.25, 1.0}) EXPECT_TRUE(times.contains(time)) << time;
  for (const double time : {-0.5, 0.0, 0.4, 0.9, 1.1}) EXPECT_FALSE(times.contains(time)) << time;
  EXPECT_EQ(times.all().size(), 5u);
}

// Round-off of a sum of steps is no other time; a small part of a step is.
TEST(OutputTimes, AreKnownUpToRoundOffOfSteps) {
  Scene scene;
  scene.time.end = 3;
  scene.time.step = 0.1;
  const OutputTimes times(scene);
  double sum = 0;
  for (int i = 0; i < 30; ++i) sum += 0.1;
  EXPECT_NE(sum, 3);
  EXPECT_TRUE(times.contains(sum));
  EXPECT_FALSE(times.contains(3 - 1e-6 * scene.time.step));
}

}  // namespace
}  // namespace sprekk
