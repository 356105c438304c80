#include "framework/results/csv_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace sprekk {
namespace {

using testing::ElementsAre;

TEST(CsvTable, reads_numbers_and_texts) {
  const CsvTable table("time[s],p_C[Pa],note\n0,1.5,\"a, \"\"b\"\"\"\n3600,,c\n");
  EXPECT_EQ(table.row_count(), 2U);
  EXPECT_THAT(table.numbers("time"), ElementsAre(0, 3600));
  EXPECT_EQ(table.numbers("p_C[Pa]")[0], 1.5);
  EXPECT_TRUE(std::isnan(table.numbers("p_C")[1]));
  EXPECT_THAT(table.texts(table.find("note")), ElementsAre("a, \"b\"", "c"));
  EXPECT_TRUE(std::isnan(table.numbers("note")[0]));
}

TEST(CsvTable, finds_columns_by_their_whole_quantity_only) {
  const CsvTable table("time[s],slip.t[m],slip[m]\n0,1,2\n");
  EXPECT_EQ(table.find("slip"), 2);
  EXPECT_EQ(table.find("sli"), -1);
  EXPECT_TRUE(table.numbers("none").empty());
}

TEST(CsvTable, leaves_out_a_row_that_was_cut_short) {
  EXPECT_THAT(CsvTable("time[s],a\n0,1\n1,2").numbers("a"), ElementsAre(1));
  EXPECT_THAT(CsvTable("time[s],a\n0,1\n1\n").numbers("a"), ElementsAre(1));
}

TEST(CsvTable, of_a_missing_file_is_empty) { EXPECT_TRUE(CsvTable::read("there/is/no.csv").columns().empty()); }

}  // namespace
}  // namespace sprekk
