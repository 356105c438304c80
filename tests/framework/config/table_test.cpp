#include "framework/config/table.hpp"
#include "framework/config/yaml/parse_yaml.hpp"

#include <fmt/format.h>
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

TEST_F(ReadTable, refuses_a_row_with_more_cells_than_columns) {
  write("t[s],p[Pa]\n0,1,5\n10,2,5\n");  // 1,5 and 2,5 with a comma for the point
  EXPECT_THAT(error(), StartsWith("p.csv:2: the row has 3 cells (the table has 2 columns)"));
  write("0,1\n10,2\n20,2,5\n");
  EXPECT_THAT(error(), StartsWith("p.csv:3: the row has 3 cells (the table has 2 columns)"));
  write("t[s],p[Pa]\n0,1,\n10,3,,\n");  // empty cells at the end, as spreadsheets write them
  EXPECT_EQ(at_time(read(), 5), 2);
}

TEST_F(ReadTable, refuses_two_columns_of_one_name) {
  write("t,p,p\n0,1,2\n10,2,3\n");
  EXPECT_THAT(error("column: p"), StartsWith("p.csv:1: two columns are called 'p' (columns 2 and 3)"));
}

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

TEST_F(ReadTable, TakesUnitsInAnyBracketsAndBehindASlash) {
  for (const char* heading : {"p[MPa]", "p (MPa)", "p {MPa}", "p / MPa", "p/MPa", "\"p (MPa)\"", "p(MPa)"}) {
    write(std::string("t (h),") + heading + "\n0,1\n2,3\n");
    EXPECT_DOUBLE_EQ(at_time(read(), 3600), 2e6) << heading;
    EXPECT_DOUBLE_EQ(at_time(read("column: p"), 3600), 2e6) << heading;
  }
  write("t,p (m/s)\n0,1\n2,3\n");
  EXPECT_THAT(error(), HasSubstr("has the dimension of velocity"));
}

TEST_F(ReadTable, RefusesWhatIsNoUnitInAHeading) {
  write("t,p (Mpa)\n0,1\n2,3\n");
  EXPECT_EQ(
      error(),
      "p.csv:1: 'Mpa' in the heading 'p (Mpa)' is no unit (what stands in brackets or behind '/' is taken for the "
      "unit of the column) write 'p[MPa]', or a name without it");
  write("t,p (left),p (right)\n0,1,2\n2,3,4\n");  // two names, of which none is needed here
  EXPECT_THAT(error("column: p (right)"), HasSubstr("'right' in the heading 'p (right)' is no unit"));
}

TEST_F(ReadTable, NamesTheSeparator) {
  write("t;p\n0;1\n2;3\n");
  EXPECT_EQ(error(),
            "p.csv:1: ';' separates the columns (cells are separated by commas, and decimals have a point) write "
            "the table with commas");
  write("t\tp\n0\t1\n2\t3\n");
  EXPECT_THAT(error(), StartsWith("p.csv:1: a tab separates the columns"));
  write("0;1\n2;3\n");
  EXPECT_THAT(error(), StartsWith("p.csv:1: ';' separates the columns"));
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
  EXPECT_THAT(error("of: x"), HasSubstr("has no column 'x' (it has y, p, and the first one is taken where none has"));
  write("place,p\n-1000,5\n0,0\n");
  EXPECT_DOUBLE_EQ(read("of: x").at({{-500, 9}, 0, 0}), 2.5);
  write("p,time\n5,0\n0,1\n");
  EXPECT_THAT(error(""), HasSubstr("call the column of the time 't'"));
}

TEST_F(ReadTable, of_several_variables_is_linear_along_each) {
  // A product of linear functions, on coordinates that are not even, in rows without an order.
  const auto f = [](double x, double y, double t) { return (1 + 2 * x) * (3 - y) * (5 + t); };
  std::string rows = "q,t[h],y,p[kPa],x[cm]\n";
  for (const double t : {2.0, 0.0, 1.0})
    for (const double x : {0.0, 4.0, 1.0, 1.5})
      for (const double y : {-1.0, 3.0})
        rows += fmt::format("9,{},{},{},{}\n", t, y, f(x, y, t * 3600) / 1000, x * 100);
  write(rows);
  const Data p = read("column: p, of: [x, t, y]");
  for (const double x : {0.0, 0.3, 1.2, 1.5, 3.9, 4.0})
    for (const double y : {-1.0, 0.7, 3.0})
      for (const double t : {0.0, 1000.0, 3600.0, 7000.0})
        EXPECT_NEAR(p.at({{x, y}, 0, t}), f(x, y, t), 1e-9 * std::abs(f(x, y, t)) + 1e-9);
  EXPECT_NEAR(p.at({{-5, -9}, 0, 1e9}), f(0, -1, 7200), 1e-6);
  EXPECT_TRUE(p.depends_on_time());
  EXPECT_TRUE(p.depends_on_space());
  about_.in_time = false;
  EXPECT_THAT(error("column: p, of: [x, t, y]"), HasSubstr("depends on time"));
}

TEST_F(ReadTable, of_several_variables_is_a_complete_grid) {
  write("x,t,p\n0,0,1\n0,1,2\n3,1,4\n3,0,3\n");
  EXPECT_DOUBLE_EQ(read("of: [x, t]").at({{1.5, 0}, 0, 0.5}), 2.5);
  write("x,t,p\n0,0,1\n0,1,2\n3,1,4\n");
  EXPECT_EQ(error("of: [x, t]"),
            "s.yaml:1:4: the table 'p.csv' is no complete grid (1 of 4 combinations of x, t have no row, the first one "
            "x = 3 m, t = 0 s) give each combination a row");
  write("x,t,p\n0,0,1\n0,1,2\n3,1,4\n0,1,7\n3,0,3\n");
  EXPECT_EQ(error("of: [x, t]"), "p.csv:5: x = 0 m, t = 1 s stands twice (line 3 has it, too) remove one of the rows");
  write("x,s,p\n0,0,1\n0,1,2\n");
  EXPECT_THAT(error("of: [x, t]"), HasSubstr("unknown variable of the table 'p.csv': 't'"));
  EXPECT_THAT(error("of: [x, x]"), HasSubstr("names x twice"));
  EXPECT_THAT(error("of: []"), HasSubstr("'of' is an empty list"));
  write("x,t,p,q\n0,0,1,1\n0,1,2,2\n");
  EXPECT_THAT(error("of: [x, t]"), HasSubstr("'column' is missing"));
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
