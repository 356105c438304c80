#include "framework/study/figure.hpp"
#include "framework/config/yaml/parse_yaml.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace sprekk {
namespace {

using testing::HasSubstr;

const ColumnNames columns = {"time[s]", "step[s]", "slip.t[m]", "count[1]"};
// Steps of 1, 1 and 2 s; slip falls, count rises and falls.
const CsvTable history("time[s],step[s],slip.t[m],count[1]\n1,1,-1,0\n2,1,-2,4\n4,2,-6,2\n");

Figure figure(const std::string& yaml) {
  FigureOptions options;
  options.name = "it";
  options.spec().read(parse_yaml(yaml, "study.yaml"), {});
  return Figure(options, columns);
}

double value(const std::string& yaml) { return figure(yaml).of(history); }

std::string refusal(const std::string& yaml) {
  try {
    figure(yaml);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Figure, takes_no_part_of_empty_cells) {
  const CsvTable gaps("time[s],step[s],slip.t[m],count[1]\n1,1,,\n2,1,-2,\n4,2,,\n5,1,-6,\n6,1,,\n");
  const auto of = [&](const std::string& yaml) { return figure(yaml).of(gaps); };
  EXPECT_DOUBLE_EQ(of("{of: slip.t, reaches: -4 m}"), 3.5);  // between the values that are known
  EXPECT_EQ(of("{of: slip.t, reaches: -6 m}"), 5);
  EXPECT_EQ(of("{of: slip.t, take: smallest}"), -6);
  EXPECT_EQ(of("{of: slip.t, take: integral}"), -8);
  EXPECT_EQ(of("{of: slip.t, take: mean}"), -4);
  EXPECT_TRUE(std::isnan(of("{of: slip.t, at: end}")));
  EXPECT_TRUE(std::isnan(of("{of: slip.t, at: 3 s}")));
  for (const std::string take : {"largest", "mean", "integral"})
    EXPECT_TRUE(std::isnan(of("{of: count, take: " + take + "}"))) << take;
  EXPECT_TRUE(std::isnan(of("{of: count, reaches: 1}")));
}

TEST(Figure, at_the_end_or_a_time_is_linear_between_steps) {
  EXPECT_EQ(value("{of: slip.t, at: end}"), -6);
  EXPECT_EQ(value("{of: slip.t, at: 2 s}"), -2);
  EXPECT_DOUBLE_EQ(value("{of: slip.t, at: 0.05 min}"), -4);
  EXPECT_TRUE(std::isnan(value("{of: slip.t, at: 0.5 s}")));
  EXPECT_TRUE(std::isnan(value("{of: slip.t, at: 5 s}")));
}

TEST(Figure, that_reaches_a_value_is_the_first_time_in_either_direction) {
  EXPECT_DOUBLE_EQ(value("{of: slip.t, reaches: -300 cm}"), 2.5);
  EXPECT_DOUBLE_EQ(value("{of: count, reaches: 3}"), 1.75);
  EXPECT_EQ(value("{of: slip.t, reaches: -2 m}"), 2);
  EXPECT_TRUE(std::isnan(value("{of: slip.t, reaches: 1 m}")));
  EXPECT_EQ(figure("{of: slip.t, reaches: -1 m}").heading(), "it[s]");
}

TEST(Figure, takes_extremes_and_weighs_means_by_steps) {
  EXPECT_EQ(value("{of: slip.t, take: largest}"), -1);
  EXPECT_EQ(value("{of: slip.t, take: smallest}"), -6);
  EXPECT_EQ(value("{of: slip.t, take: farthest_from_zero}"), -6);
  EXPECT_DOUBLE_EQ(value("{of: count, take: mean}"), 2);
  EXPECT_DOUBLE_EQ(value("{of: count, take: integral}"), 8);
  EXPECT_EQ(figure("{of: count, take: integral}").unit(), "s");
  EXPECT_EQ(figure("{of: slip.t, take: integral}").heading(), "it[m*s]");
}

TEST(Figure, refuses_what_it_does_not_understand) {
  EXPECT_THAT(refusal("{of: slip.r, at: end}"), HasSubstr("study.yaml:1:6: unknown column of history.csv 'slip.r'"));
  EXPECT_THAT(refusal("{of: slip.r, at: end}"), HasSubstr("did you mean 'slip.t'?"));
  EXPECT_THAT(refusal("{of: slip.t, reaches: 1 Pa}"),
              HasSubstr("study.yaml:1:23: '1 Pa' for 'reaches' has the dimension"));
  EXPECT_THAT(refusal("{of: slip.t, at: 1 m}"), HasSubstr("study.yaml:1:18"));
  EXPECT_THAT(refusal("{of: slip.t}"), HasSubstr("needs one of 'at', 'reaches' and 'take'"));
  EXPECT_THAT(refusal("{of: slip.t, at: end, take: largest}"), HasSubstr("is not defined"));
  EXPECT_THAT(refusal("{of: slip.t, take: max}"), HasSubstr("unknown value of 'take'"));
}

TEST(Figure, of_an_empty_history_is_no_number) {
  EXPECT_TRUE(std::isnan(figure("{of: slip.t, at: end}").of(CsvTable())));
}

}  // namespace
}  // namespace sprekk
