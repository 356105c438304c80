#include "framework/run/note_records.hpp"

#include <gtest/gtest.h>

namespace sprekk {
namespace {

TEST(Notes, CountTheStepsOfATopicAndTellTheWorst) {
  Notes notes;
  notes.at_time(2);
  notes.add("suction", "-1 Pa", 1);
  notes.add("suction", "-0.5 Pa", 0.5);  // another place of the same step
  notes.add("strain", "2 %");
  notes.at_time(3);
  notes.at_time(5);
  notes.add("suction", "-7 Pa", 7);
  notes.add("strain", "3 %");
  notes.at_time(6);
  notes.add("suction", "-2 Pa", 2);
  ASSERT_EQ(notes.all().size(), 2U);
  EXPECT_EQ(described(records_of(notes)[0]), "-7 Pa [3 steps, from 2 s to 6 s]");
  EXPECT_EQ(described(records_of(notes)[1]), "2 % [2 steps, from 2 s to 5 s]");
}

TEST(Notes, OfTheInputAreOfNoStep) {
  Notes notes;
  notes.of_input(60);
  notes.add("gravity", "no density");
  notes.add("gravity", "no density");
  ASSERT_EQ(notes.all().size(), 1U);
  EXPECT_EQ(notes.all()[0].steps, 0);
  EXPECT_EQ(notes.all()[0].first_time, 60);
  EXPECT_EQ(described(records_of(notes)[0]), "no density");
}

TEST(Notes, GoOnAfterARestart) {
  Notes before;
  before.at_time(1);
  before.add("suction", "-1 Pa", 1);
  Notes notes;
  notes.restore(notes_of(records_of(before)));
  notes.at_time(2);
  notes.add("suction", "-0.5 Pa", 0.5);
  EXPECT_EQ(described(records_of(notes)[0]), "-1 Pa [2 steps, from 1 s to 2 s]");
}

}  // namespace
}  // namespace sprekk
