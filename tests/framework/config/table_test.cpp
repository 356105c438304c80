#include "framework/config/table.hpp"
#include "framework/config/yaml/parse_yaml.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "framework/config/data_reader.hpp"
#include "tests/framework/config/messages.hpp"

namespace sprekk {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class ReadTable : public testing::Test {
 protected:
  ReadTable() {
    context_.folder =
        (std::filesystem::temp_directory_path() / ("sprekk_table_" + std::to_string(getpid()) + "_" +
                                                   testing::UnitTest::GetInstance()->current_test_info()->name()))
            .string();
    std::filesystem::create_directories(context_.folder);
  }
  ~ReadTable() override { std::filesystem::remove_all(context_.folder); }

  void write(const std::string& content) const { std::ofstream(context_.folder + "/p.csv") << content; }

  Data read(const std::string& keys = "") const {
    const Node scene = parse_yaml("p: {table: p.csv" + (keys.empty() ? "" : ", " + keys) + "}", "s.yaml");
    return read_data(*scene.find("p"), {"p", about_, context_});
  }

  std::string error(const std::string& keys = "") const {
    return input_error_of([&] { read(keys); });
  }

  static double at_time(const Data& data, double t) { return data.at({Point::Zero(), 0, t}); }

  About about_{.unit = "Pa", .in_time = true};
  ReadContext context_;
};

TEST_F(ReadTable, is_linear_between_rows_and_constant_outside) {
  write("# measured\nt,p\n0,1\n10,3\n\n20,-1\n");
  const Data p = read();
  EXPECT_EQ(at_time(p, -5), 1);
  EXPECT_EQ(at_time(p, 0), 1);
  EXPECT_EQ(at_time(p, 5), 2);
  EXPECT_EQ(at_time(p, 10), 3);
  EXPECT_EQ(at_time(p, 15), 1);
  EXPECT_EQ(at_time(p, 20), -1);
  EXPECT_EQ(at_time(p, 99), -1);
  EXPECT_TRUE(p.depends_on_time());
  EXPECT_FALSE(p.depends_on_space());
}

TEST_F(ReadTable, takes_units_from_the_headings) {
  write("time[h],p[MPa]\r\n0,1\r\n2,3\r\n");
  EXPECT_DOUBLE_EQ(at_time(read(), 3600), 2e6);
}

TEST_F(ReadTable, takes_the_unit_of_the_request_first) {
  write("0,1\n2,3\n");
  EXPECT_DOUBLE_EQ(at_time(read("unit: kPa"), 1), 2e3);
}

TEST_F(ReadTable, finds_columns_by_name_and_by_number) {
  write("a,\"t[s]\",p,q\n7,0,1,10\n5,1,2,20\n");
  EXPECT_EQ(at_time(read("column: q"), 1), 20);
  EXPECT_EQ(at_time(read("column: 3"), 1), 2);
  EXPECT_EQ(at_time(read("column: 4"), 0.5), 15);
}

TEST_F(ReadTable, may_depend_on_a_coordinate) {
  write("y,p\n0,0\n-1000,5\n");
  EXPECT_THAT(error("of: y"), HasSubstr("must increase"));
  write("y,p\n-1000,5\n0,0\n");
  const Data p = read("of: y");
  EXPECT_DOUBLE_EQ(p.at({{3, -500}, 0, 0}), 2.5);
  EXPECT_TRUE(p.depends_on_space());
  EXPECT_DOUBLE_EQ(read("of: x").at({{-500, 9}, 0, 0}), 2.5);
}

TEST_F(ReadTable, names_the_wrong_line) {
  write("t,p\n0,1\n1,abc\n");
  EXPECT_EQ(error(), "p.csv:3: 'abc' in column 2 is not a finite number (units stand in the heading, like p[MPa])");
  write("t,p\n0,1\n1,2 MPa\n");
  EXPECT_THAT(error(), StartsWith("p.csv:3: '2 MPa' in column 2 is not a finite number"));
  write("t,p\n0,1\n1,nan\n");
  EXPECT_THAT(error(), StartsWith("p.csv:3: 'nan' in column 2 is not a finite number"));
  write("t,p\n0,1\n1,\n");
  EXPECT_THAT(error(), StartsWith("p.csv:3: '' in column 2 is not a finite number"));
  write("t,p\n0,1\n1\n");
  EXPECT_EQ(error(), "p.csv:3: the row has no column 2 (it has 1)");
  write("t,p\n0,1\n1,2\n1,3\n");
  EXPECT_EQ(
      error(),
      "p.csv:4: '1' does not follow the row before (the column of t must increase from row to row) sort the rows");
}

TEST_F(ReadTable, names_what_is_missing) {
  EXPECT_EQ(
      error(),
      "s.yaml:1:4: the table 'p.csv' cannot be used (p.csv: cannot be read (No such file or directory)) tables are "
      "looked for beside the scene file");
  write("");
  EXPECT_THAT(error(), HasSubstr("is empty (it has"));
  write("t,p\n");
  EXPECT_THAT(error(), HasSubstr("it has headings only"));
  write("t,p,q\n0,1,2\n");
  EXPECT_THAT(error(), HasSubstr("'column' is missing for the table 'p.csv' (the table has 3 columns: t, p, q)"));
  EXPECT_THAT(error("column: r"), HasSubstr("unknown column of the table 'p.csv': 'r' (it is not one of: t, p, q)"));
  EXPECT_THAT(error("column: 4"), HasSubstr("the table 'p.csv' has no column 4 (its columns are 1 to 3)"));
  EXPECT_THAT(error("column: 0"), HasSubstr("has no column 0"));
  EXPECT_THAT(error("column: p, of: z"), HasSubstr("unknown variable of a table: 'z' (it is not one of: t, x, y)"));
  EXPECT_THAT(error("column: p, unit: m"), HasSubstr("has the dimension of length"));
  write("t,p[m]\n0,1\n");
  EXPECT_THAT(error(), HasSubstr("p.csv:1: 'm' for 'p' has the dimension of length"));
}

TEST_F(ReadTable, checks_the_range_of_every_row) {
  write("t,p\n0,1\n1,-2\n");
  about_.range = non_negative();
  EXPECT_EQ(error(), "s.yaml:1:4: 'p' is -2 in the table 'p.csv', out of range (it must be >= 0 Pa)");
}

}  // namespace
}  // namespace sprekk
