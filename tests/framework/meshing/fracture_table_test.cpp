#include "framework/meshing/fracture_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace sprekk {
namespace {

class FractureTables : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::path(::testing::TempDir()) / ::testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::vector<FractureGeometry> read(const std::string& content) {
    std::ofstream(folder_ / "f.csv") << content;
    return read_fracture_table({"f.csv", folder_.string(), "set", {"scene.yaml", 3}});
  }
  std::string mistake(const std::string& content) {
    try {
      require_used_columns(read(content), {"friction"});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path folder_;
};

TEST_F(FractureTables, HaveARowForEachSegment) {
  const auto fractures = read("# mapped\nx1, y1[mm], x2, y2, size[cm]\n0.5,250,1.5,0.75,2\n-1,0,1e-1,3,5\n");
  ASSERT_EQ(fractures.size(), 2u);
  EXPECT_EQ(fractures[0].name, "set_1");
  EXPECT_EQ(fractures[1].name, "set_2");
  EXPECT_EQ(fractures[0].points, (std::vector<Point>{Point(0.5, 0.25), Point(1.5, 0.75)}));
  EXPECT_DOUBLE_EQ(*fractures[0].size, 0.02);
  EXPECT_EQ(fractures[1].points, (std::vector<Point>{Point(-1, 0), Point(0.1, 3)}));
  EXPECT_EQ(fractures[1].origin.line, 4);
}

TEST_F(FractureTables, TakeUnitsInAnyBracketsAndBehindASlash) {
  const auto fractures = read("x1 (mm),y1 {mm},x2 / km,y2[cm],size (mm),aperture (mm)\n500,250,0.002,75,20,3\n");
  EXPECT_EQ(fractures[0].points, (std::vector<Point>{Point(0.5, 0.25), Point(2, 0.75)}));
  EXPECT_DOUBLE_EQ(*fractures[0].size, 0.02);
  EXPECT_EQ(fractures[0].values[0].column, "aperture");
  EXPECT_EQ(fractures[0].values[0].unit, "mm");
  EXPECT_THAT(mistake("x1 (M),y1,x2,y2\n1,2,3,4\n"),
              ::testing::StartsWith("f.csv:1: 'M' in the heading 'x1 (M)' is no unit"));
  EXPECT_THAT(mistake("x1;y1;x2;y2\n1;2;3;4\n"), ::testing::StartsWith("f.csv:1: ';' separates the columns"));
}

TEST_F(FractureTables, OrOneForEachPointOfAPolyline) {
  const auto fractures = read("name,x,y\na,0,1\na,2,1\na,3,4\n\"b c\",9,9\n\"b c\",8,9\n");
  ASSERT_EQ(fractures.size(), 2u);
  EXPECT_EQ(fractures[0].name, "a");
  EXPECT_EQ(fractures[0].points, (std::vector<Point>{Point(0, 1), Point(2, 1), Point(3, 4)}));
  EXPECT_EQ(fractures[1].name, "b c");
  EXPECT_FALSE(fractures[1].size);
}

TEST_F(FractureTables, HaveFurtherColumnsForData) {
  const auto fractures = read("x1,y1,x2,y2,friction,aperture[mm]\n0,0,1,1,0.3,2\n0,1,1,2,0.6,5\n");
  ASSERT_EQ(fractures.size(), 2u);
  ASSERT_EQ(fractures[1].values.size(), 2u);
  EXPECT_EQ(fractures[1].values[0].column, "friction");
  EXPECT_EQ(fractures[1].values[0].value, 0.6);
  EXPECT_EQ(fractures[1].values[1].unit, "mm");
  EXPECT_EQ(fractures[1].values[1].value, 5);
  EXPECT_EQ(fractures[1].values[1].where.line, 3);
  const auto line = read("name,x,y,friction\na,0,0,0.4\na,1,0,0.4\n");
  ASSERT_EQ(line.size(), 1u);
  EXPECT_EQ(line[0].values[0].value, 0.4);
}

TEST_F(FractureTables, AreWrittenToTheLastBit) {
  const auto same = [&](const std::string& content) {
    const auto fractures = read(content);
    const std::string text = fracture_table(fractures);
    const auto again = read(text);
    EXPECT_EQ(fracture_table(again), text);
    ASSERT_EQ(again.size(), fractures.size());
    for (std::size_t i = 0; i < again.size(); ++i) {
      EXPECT_EQ(again[i].name, fractures[i].name);
      EXPECT_EQ(again[i].points, fractures[i].points);
      EXPECT_EQ(again[i].size, fractures[i].size);
      ASSERT_EQ(again[i].values.size(), fractures[i].values.size());
      for (std::size_t k = 0; k < again[i].values.size(); ++k) {
        EXPECT_EQ(again[i].values[k].column, fractures[i].values[k].column);
        EXPECT_EQ(again[i].values[k].unit, fractures[i].values[k].unit);
        EXPECT_EQ(again[i].values[k].value, fractures[i].values[k].value);
      }
    }
  };
  same("x1, y1[mm], x2, y2, size[cm], friction, aperture[mm]\n0.1,0.3,1e-17,3e20,0.7,0.6,2\n1,2,3,4,5,6,7\n");
  same("name,x,y,size\na,0,1,2\na,2,1,2\na,3,4,2\nb c,9,9,1\nb c,8,9,1\n");
}

TEST_F(FractureTables, AreNotWrittenWithNamesThatTheyCannotHold) {
  auto fractures = read("x1,y1,x2,y2\n1,2,3,4\n");
  EXPECT_NO_THROW(fracture_table(fractures));
  fractures[0].name = "a,b";
  EXPECT_THROW(fracture_table(fractures), InputError);
  fractures[0].name = "#1";
  EXPECT_THROW(fracture_table(fractures), InputError);
  EXPECT_THROW(fracture_table({}), InputError);
}

TEST_F(FractureTables, HaveOneValueForAllPointsOfAPolyline) {
  EXPECT_EQ(mistake("name,x,y,friction\na,0,1,0.3\na,2,1,0.3\n"), "");
  EXPECT_THAT(mistake("name,x,y,friction\na,0,1,0.3\na,2,1,0.6\n"),
              ::testing::StartsWith("f.csv:3: fracture 'a' has two values of friction (the other one is at f.csv:2)"));
  EXPECT_THAT(mistake("name,x,y,size\na,0,1,0.3\na,2,1,0.6\n"),
              ::testing::StartsWith("f.csv:3: fracture 'a' has two values of size"));
}

TEST_F(FractureTables, RefuseARowWithMoreCellsThanColumns) {
  EXPECT_THAT(mistake("x1,y1,x2,y2\n0,0,1,5,1\n"), ::testing::StartsWith("f.csv:2: the row has 5 cells"));
}

TEST_F(FractureTables, TellWhatIsWrongAndWhere) {
  using ::testing::AllOf;
  using ::testing::HasSubstr;
  EXPECT_THAT(mistake("0,0,1,1\n"), AllOf(HasSubstr("scene.yaml:3"), HasSubstr("no headings")));
  EXPECT_THAT(mistake("x1,y1,x2,y2\n"), HasSubstr("headings only"));
  EXPECT_THAT(mistake("x1,y1,x2\n1,2,3\n"), HasSubstr("lacks columns"));
  EXPECT_THAT(mistake("x1,y1,x2,y2,sise\n1,2,3,4,5\n"),
              AllOf(HasSubstr("f.csv:1"), HasSubstr("'sise'"), HasSubstr("size")));
  EXPECT_THAT(mistake("x1,y1,x2,y2,friction\n1,2,3,4,low\n"),
              AllOf(HasSubstr("f.csv:2"), HasSubstr("'low' for friction is not a finite number")));
  EXPECT_THAT(mistake("x1,y1,x2,y2\n1,2,3,4\n1,2,3\n"), AllOf(HasSubstr("f.csv:3"), HasSubstr("no y2")));
  EXPECT_THAT(mistake("x1,y1,x2,y2\n1,2,3 m,4\n"), AllOf(HasSubstr("f.csv:2"), HasSubstr("'3 m' for x2")));
  EXPECT_THAT(mistake("x1[s],y1,x2,y2\n1,2,3,4\n"), HasSubstr("f.csv:1"));
  EXPECT_THAT(mistake("x1,y1,x2,y2,size\n1,2,3,4,0\n"), HasSubstr("not positive"));
  EXPECT_THAT(mistake("name,x,y,x1,y1,x2,y2\na,1,2,1,2,3,4\n"), HasSubstr("ends and points"));
}

}  // namespace
}  // namespace sprekk
