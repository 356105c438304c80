#include "framework/run/cumulative_balance.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sprekk {
namespace {

std::map<std::string, Balance> fluid(double stored, double injected, double outflow, double throughput,
                                     bool is_closed = true) {
  return {{"fluid", {stored, injected, outflow, throughput, "m^2", is_closed}}};
}

constexpr double loose = 1e-3;  // of what a step moves, as a schedule keeps balances

TEST(CumulativeBalance, AreOffByRoundOffAloneWhereStepsKeepThem) {
  // Nothing moves: the amounts are what solvers leave of large ones.
  for (const double tolerance : {1e-8, 1e-6, loose}) {
    CumulativeBalance balance;
    Notes notes;
    balance.note_step(fluid(1e-12, 0, 0, 1e-12), tolerance, notes);
    EXPECT_EQ(notes.empty(), tolerance <= 1e-6) << tolerance;
  }
}

TEST(CumulativeBalance, ThatAreOffByMoreThanAMillionthOfWhatWasMovedAreTold) {
  for (const double error : {2e-6, -2e-6, 0.5e-6, -0.5e-6, 0.0}) {
    CumulativeBalance balance;
    Notes notes;
    balance.note_step(fluid(3 + 4 * error, 4, 1, 4), loose, notes);
    ASSERT_EQ(notes.all().size(), std::abs(error) > 1e-6 ? 1U : 0U) << error;
    for (const Notes::Note& note : notes.all()) EXPECT_NEAR(note.measure, std::abs(error), 1e-12);
  }
}

TEST(CumulativeBalance, AreComparedWithTheLargestThroughputSoFar) {
  // What has been put in has been taken out again: the balance is empty, and what is left is rounding.
  CumulativeBalance balance;
  Notes notes;
  balance.note_step(fluid(1, 1, 0, 1), loose, notes);
  balance.note_step(fluid(1e-9, 0, 0, 1e-9), loose, notes);
  EXPECT_TRUE(notes.empty());
  // After a restart, too.
  std::map<std::string, Vector> kept;
  balance.save(kept);
  CumulativeBalance restored, forgetful;
  restored.restore(kept);
  restored.note_step(fluid(1e-9, 0, 0, 1e-9), loose, notes);
  EXPECT_TRUE(notes.empty());
  forgetful.note_step(fluid(1e-9, 0, 0, 1e-9), loose, notes);
  EXPECT_EQ(notes.all().size(), 1U);
}

TEST(CumulativeBalance, OfAPartWithoutThroughputAreComparedWithTheirAmounts) {
  for (const double sign : {1.0, -1.0})
    for (const double error : {2e-6, 0.5e-6}) {
      CumulativeBalance balance;
      Notes notes;
      balance.note_step(fluid(sign * (2e7 + 5e7 * error), sign * 5e7, sign * 3e7, 0), loose, notes);
      ASSERT_EQ(notes.all().size(), error > 1e-6 ? 1U : 0U) << error;
      for (const Notes::Note& note : notes.all()) EXPECT_NEAR(note.measure, error, 1e-12);
    }
  // Outflow alone, and storage alone.
  for (const auto& amounts : {fluid(1e-9, 0, 3, 0), fluid(3, 0, 1e-9, 0)}) {
    CumulativeBalance balance;
    Notes notes;
    balance.note_step(amounts, loose, notes);
    ASSERT_EQ(notes.all().size(), 1U);
    for (const Notes::Note& note : notes.all()) EXPECT_NEAR(note.measure, 1, 1e-6);
  }
}

TEST(CumulativeBalance, ThatAreNotClosedAreNotTold) {
  CumulativeBalance balance;
  Notes notes;
  balance.note_step(fluid(1, 0, 0, 1, false), loose, notes);
  EXPECT_TRUE(notes.empty());
}

}  // namespace
}  // namespace sprekk
