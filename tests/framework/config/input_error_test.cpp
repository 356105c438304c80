#include "framework/config/input_error.hpp"

#include <gtest/gtest.h>

namespace sprekk {
namespace {

TEST(Origin, tells_what_is_known) {
  EXPECT_EQ((Origin{"scene.yaml", 12, 5}).text(), "scene.yaml:12:5");
  EXPECT_EQ((Origin{"table.csv", 7}).text(), "table.csv:7");
  EXPECT_EQ(Origin{"--set"}.text(), "--set");
}

TEST(InputError, says_problem_why_and_suggestion) {
  EXPECT_STREQ(InputError({"a.yaml", 1, 2}, "problem", "why", "suggestion").what(),
               "a.yaml:1:2: problem (why) suggestion");
  EXPECT_STREQ(InputError({"a.yaml", 1, 2}, "problem").what(), "a.yaml:1:2: problem");
  EXPECT_STREQ(InputError({}, "problem", "why").what(), "problem (why)");
}

TEST(InputError, shows_ten_of_many_problems_and_keeps_all) {
  std::vector<std::string> problems;
  for (int i = 0; i < 13; ++i) problems.push_back("problem " + std::to_string(i));
  const InputError error(problems);
  const std::string text = error.what();
  EXPECT_EQ(error.problems().size(), 13U);
  EXPECT_NE(text.find("problem 9\nand 3 more"), std::string::npos);
  EXPECT_EQ(text.find("problem 10"), std::string::npos);
}

TEST(Quoted, stays_on_one_line_and_short) {
  EXPECT_EQ(quoted("a\nb"), "'a b'");
  EXPECT_EQ(quoted(std::string(500, 'a')), "'" + std::string(80, 'a') + "…'");
}

TEST(UnknownName, lists_and_suggests) {
  EXPECT_STREQ(unknown_name({"s.yaml", 2, 3}, "region", "granit", {"granite", "lens"}).what(),
               "s.yaml:2:3: unknown region 'granit' (it is not one of: granite, lens) did you mean 'granite'?");
  EXPECT_STREQ(unknown_name({"s.yaml", 2, 3}, "region", "xyz", {"granite"}).what(),
               "s.yaml:2:3: unknown region 'xyz' (it is not one of: granite)");
  EXPECT_STREQ(unknown_name({"s.yaml", 2, 3}, "region", "xyz", {}).what(),
               "s.yaml:2:3: unknown region 'xyz' (there is none)");
}

}  // namespace
}  // namespace sprekk
