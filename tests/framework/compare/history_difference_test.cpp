#include "framework/compare/history_difference.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace sprekk {
namespace {

using testing::DoubleEq;
using testing::DoubleNear;

TEST(HistoryDifference, is_exact_between_rows_of_different_times) {
  // t and t^2/10 at other times: lines between (0,0), (4,1.6), (10,10) and the line t are farthest apart at 4.
  const CsvTable line("time[s],a[m]\n0,0\n10,10\n20,20\n"), bent("time[s],a[m]\n0,0\n4,1.6\n10,10\n14,14\n");
  const auto differences = history_differences(line, bent);
  ASSERT_EQ(differences.size(), 1U);
  EXPECT_THAT(differences[0].largest, DoubleEq(2.4));
  EXPECT_EQ(differences[0].time, 4);
  EXPECT_THAT(differences[0].scale, DoubleEq(14));  // of the common time, until 14
  EXPECT_EQ(common_time(line, bent).last, 14);
  const auto swapped = history_differences(bent, line);
  EXPECT_EQ(swapped[0].largest, differences[0].largest);
  EXPECT_EQ(swapped[0].scale, differences[0].scale);
}

TEST(HistoryDifference, finds_a_millionth_of_the_range) {
  std::string table = "time[s],a[Pa]\n", changed = table;
  for (int i = 0; i < 100; ++i) {
    const double value = 5e6 + 1e5 * std::sin(0.07 * i);
    table += std::to_string(i) + "," + std::to_string(value) + "\n";
    changed += std::to_string(i) + "," + std::to_string(i == 37 ? value + 0.2 : value) + "\n";
  }
  const auto differences = history_differences(CsvTable(table), CsvTable(changed));
  EXPECT_EQ(differences[0].time, 37);
  EXPECT_THAT(differences[0].largest / differences[0].scale, DoubleNear(1e-6, 2e-9));
  EXPECT_EQ(history_differences(CsvTable(table), CsvTable(table))[0].largest, 0);
}

TEST(HistoryDifference, measures_components_and_balances_against_their_largest) {
  const std::string head = "time[s],slip.n[m],slip.t[m],water_stored[m^2],water_balance_error[m^2],other[m]\n";
  const CsvTable one(head + "0,0,0,0,0,0\n1,1e-20,1e-3,2,1e-17,3\n");
  const CsvTable other(head + "0,0,0,0,0,0\n1,-1e-20,1e-3,2,-1e-17,3\n");
  const auto differences = history_differences(one, other);
  ASSERT_EQ(differences.size(), 5U);
  EXPECT_THAT(differences[0].scale, DoubleEq(1e-3));
  EXPECT_THAT(differences[3].scale, DoubleEq(2));
  EXPECT_THAT(differences[4].scale, DoubleEq(3));
}

TEST(HistoryDifference, measures_a_constant_with_round_off_against_its_size) {
  const CsvTable one("time[s],a[Pa]\n0,5e6\n1,5000000.000000001\n"), other("time[s],a[Pa]\n0,5e6\n1,5e6\n");
  EXPECT_THAT(history_differences(one, other)[0].scale, DoubleNear(5e6, 1));
}

TEST(HistoryDifference, sees_a_value_that_one_run_alone_has) {
  const CsvTable one("time[s],a[m]\n0,1\n1,\n2,2\n"), other("time[s],a[m]\n0,1\n1,1.5\n2,2\n");
  const auto differences = history_differences(one, other);
  EXPECT_TRUE(std::isinf(differences[0].largest));
  EXPECT_EQ(differences[0].time, 1);
  // What begins between rows of the other run is no difference by itself.
  const CsvTable later("time[s],a[m]\n0,1\n1.5,1.75\n2,2\n");
  EXPECT_EQ(history_differences(one, later)[0].largest, 0);
}

TEST(HistoryDifference, has_nothing_for_histories_without_common_time) {
  const CsvTable one("time[s],a[m]\n0,1\n1,1\n"), other("time[s],a[m]\n2,1\n3,1\n");
  EXPECT_TRUE(history_differences(one, other).empty());
}

}  // namespace
}  // namespace sprekk
