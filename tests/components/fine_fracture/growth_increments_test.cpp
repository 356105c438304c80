// Eq. 13 of the paper.
#include "components/fine_fracture/growth/increments.hpp"

#include <gtest/gtest.h>

namespace sprekk::fine_fracture {
namespace {

TEST(IncrementLengths, follow_the_energies) {
  const std::vector<double> lengths = increment_lengths({8.0, 16.0, 1.0}, 0.02, 0.35);
  EXPECT_NEAR(lengths[0], 0.02 * 0.784584, 1e-8);  // 2^−0.35
  EXPECT_DOUBLE_EQ(lengths[1], 0.02);
  EXPECT_NEAR(lengths[2], 0.02 * 0.378929, 1e-8);  // 16^−0.35
}

TEST(IncrementLengths, a_single_tip_takes_the_whole_increment) {
  EXPECT_EQ(increment_lengths({3.7}, 0.02, 0.35), std::vector<double>{0.02});
}

TEST(IncrementLengths, without_energy_nothing_grows) {
  EXPECT_TRUE(increment_lengths({}, 0.02, 0.35).empty());
  EXPECT_EQ(increment_lengths({0, 0}, 0.02, 0.35), (std::vector<double>{0, 0}));
  EXPECT_EQ(increment_lengths({1, 0}, 0.02, 0.35), (std::vector<double>{0.02, 0}));
}

}  // namespace
}  // namespace sprekk::fine_fracture
