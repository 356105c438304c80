#include "framework/output/table_writer.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/framework/output/small_case.hpp"

namespace sprekk {
namespace {

class TableWriterTest : public TemporaryFolder {
 protected:
  std::filesystem::path file = folder / "history.csv";
};

TEST_F(TableWriterTest, TheFirstRowFixesTheColumns) {
  TableWriter table(file);
  EXPECT_FALSE(std::filesystem::exists(file));
  table.append(0.5, {{"step", 1.0}, {"well.pressure[Pa]", 2e6}});
  table.append(1, {{"well.pressure[Pa]", 3e6}, {"step", 2.0}});  // order does not matter
  table.append(2, {{"step", 3.0}});                              // a value may be missing
  EXPECT_EQ(read_text(file), "time[s],step,well.pressure[Pa]\n0.5,1,2000000\n1,2,3000000\n2,3,\n");
  EXPECT_THROW(table.append(3, {{"new[m]", 1.0}}), std::logic_error);
}

TEST_F(TableWriterTest, WhatIsNotKnownIsAnEmptyCell) {
  TableWriter table(file);
  table.append(1, {{"x[m]", std::nan("")}, {"y[m]", 2.0}});
  table.append(2, {{"x[m]", 1.0}, {"y[m]", -std::nan("")}});
  EXPECT_EQ(read_text(file), "time[s],x[m],y[m]\n1,,2\n2,1,\n");
}

TEST_F(TableWriterTest, NumbersComeBackToTheBit) {
  const std::vector<double> values = {1.0 / 3, M_PI * 1e-300, 0.1, 5e-324, -1e22 / 7, 123456789.123456789};
  TableWriter table(file);
  for (const double value : values) table.append(value, {{"x[m]", value}});
  std::istringstream lines(read_text(file));
  std::string line;
  std::getline(lines, line);
  for (const double value : values) {
    std::getline(lines, line);
    EXPECT_EQ(std::strtod(line.c_str(), nullptr), value);
    EXPECT_EQ(std::strtod(line.c_str() + line.find(',') + 1, nullptr), value);
  }
}

TEST_F(TableWriterTest, EveryRowIsInTheFileAtOnce) {
  TableWriter table(file);
  table.append(1, {{"x[m]", 1.0}});
  EXPECT_EQ(read_text(file), "time[s],x[m]\n1,1\n");
}

TEST_F(TableWriterTest, TextIsQuotedWhereItMustBe) {
  TableWriter table(file);
  table.append(1, {{"solve, inner", std::string("plain")}, {"reason", std::string("a \"b\", c\nd")}});
  EXPECT_EQ(read_text(file), "time[s],\"solve, inner\",reason\n1,plain,\"a \"\"b\"\", c d\"\n");
  EXPECT_THAT(TableWriter::continued(file, 1).columns(), testing::ElementsAre("solve, inner", "reason"));
}

TEST_F(TableWriterTest, ARestartRemovesLaterRows) {
  const double third = 1.0 / 3;
  {
    TableWriter table(file);
    table.append(0, {{"x[m]", 0.0}});
    table.append(third, {{"x[m]", 1.0}});
    table.append(third, {{"x[m]", 2.0}});  // an iteration of the same step
    table.append(std::nextafter(third, 1), {{"x[m]", 3.0}});
    table.append(1, {{"x[m]", 4.0}});
  }
  const std::string before = read_text(file);
  TableWriter table = TableWriter::continued(file, third);
  const std::string kept = read_text(file);
  EXPECT_EQ(before.substr(0, kept.size()), kept);
  EXPECT_THAT(kept, testing::EndsWith(",2\n"));
  table.append(0.5, {{"x[m]", 9.0}});
  EXPECT_EQ(read_text(file), kept + "0.5,9\n");
  EXPECT_THROW(table.append(0.6, {{"y[m]", 9.0}}), std::logic_error) << "the columns are those of the old rows";
}

TEST_F(TableWriterTest, ARowThatWasCutShortIsRemoved) {
  write_text(file, "time[s],x[m]\n1,1\n2,2");
  TableWriter::continued(file, 10).append(3, {{"x[m]", 3.0}});
  EXPECT_EQ(read_text(file), "time[s],x[m]\n1,1\n3,3\n");
}

TEST_F(TableWriterTest, AMissingOrEmptyTableIsANewOne) {
  TableWriter::continued(file, 1).append(2, {{"x[m]", 2.0}});
  EXPECT_EQ(read_text(file), "time[s],x[m]\n2,2\n");
  write_text(file, "");
  TableWriter::continued(file, 1).append(2, {{"x[m]", 2.0}});
  EXPECT_EQ(read_text(file), "time[s],x[m]\n2,2\n");
}

TEST_F(TableWriterTest, KeepsRowsByTheirNumberWhereItIsKnown) {
  // The second and third row are attempts that ended later than the checkpoint at 1 s, which the fourth belongs to.
  const std::string head = "time[s],x[m]\n0.5,1\n4,2\n2,3\n1,4\n";
  write_text(file, head + "3,5\n1,6\n");
  TableWriter table = TableWriter::continued(file, 1, 4);
  EXPECT_EQ(table.rows(), 4);
  table.append(2, {{"x[m]", 7.0}});
  EXPECT_EQ(table.rows(), 5);
  EXPECT_EQ(read_text(file), head + "2,7\n");
  EXPECT_THAT(input_error_of([&] { TableWriter::continued(file, 1, 6); }), testing::HasSubstr("has 5 rows"));
  EXPECT_THAT(input_error_of([&] { TableWriter::continued(folder / "none.csv", 1, 6); }),
              testing::HasSubstr("missing"));
}

TEST_F(TableWriterTest, AnotherKindOfFileIsRefused) {
  write_text(file, "a,b\n1,2\n");
  EXPECT_THAT(input_error_of([&] { TableWriter::continued(file, 1); }), testing::HasSubstr("time[s]"));
  EXPECT_EQ(read_text(file), "a,b\n1,2\n");
}

TEST_F(TableWriterTest, FollowsNoLink) {
  const auto outside = folder / "outside.csv";
  const std::string text = "time[s],x[m]\n1,1\n";
  write_text(outside, text);
  std::filesystem::create_symlink(outside, file);
  EXPECT_THAT(input_error_of([&] { TableWriter::continued(file, 1, 1); }), testing::HasSubstr("symbolic link"));
  EXPECT_EQ(read_text(outside), text);
  std::filesystem::remove(file);
  write_text(file, text);
  TableWriter table = TableWriter::continued(file, 1, 1);
  std::filesystem::remove(file);
  std::filesystem::create_symlink(outside, file);  // between the restart and its first row
  EXPECT_THROW(table.append(2, {{"x[m]", 2.0}}), std::runtime_error);
  EXPECT_EQ(read_text(outside), text);
}

TEST_F(TableWriterTest, ARemovedFileBeginsAnewAndIsTold) {
  TableWriter table(file);
  for (const double time : {1.0, 2.0, 3.0}) table.append(time, {{"x[m]", time}});
  EXPECT_EQ(table.loss(), "");
  std::filesystem::remove(file);
  table.append(4, {{"x[m]", 4.0}});
  table.append(5, {{"x[m]", 5.0}});
  EXPECT_EQ(read_text(file), "time[s],x[m]\n4,4\n5,5\n");
  EXPECT_EQ(table.rows(), 2) << "a restart counts what is in the file";
  EXPECT_THAT(table.loss(), testing::HasSubstr("history.csv was removed while the run wrote it, with 3 rows"));
}

TEST_F(TableWriterTest, AnotherFileInItsPlaceIsNotTouched) {
  TableWriter table(file);
  table.append(1, {{"x[m]", 1.0}});
  std::filesystem::remove(file);
  write_text(file, "of somebody else");
  EXPECT_THROW(table.append(2, {{"x[m]", 2.0}}), std::runtime_error);
  EXPECT_EQ(read_text(file), "of somebody else");
}

TEST_F(TableWriterTest, AnUnwritablePlaceIsAnError) {
  TableWriter table(folder / "missing" / "history.csv");
  EXPECT_THROW(table.append(0, {}), std::runtime_error);
}

}  // namespace
}  // namespace sprekk
