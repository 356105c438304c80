#include "framework/meshing/fracture_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "framework/meshing/clip_fracture.hpp"

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

  std::vector<FractureGeometry> read(const std::string& content, const std::string& file = "f.csv") {
    std::ofstream(folder_ / file) << content;
    return read_fracture_table({file, folder_.string(), "set", {"scene.yaml", 3}});
  }
  std::string mistake_of_json(const std::string& content) {
    try {
      read(content, "f.geojson");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
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

TEST_F(FractureTables, TakeTheUsualNamesOfColumnsAlsoBehindAHash) {
  for (const std::string headings : {"FID,START_X,START_Y,END_X,END_Y", "# FID, START_X, START_Y, END_X, END_Y",
                                     "id,x_start,y_start,x_end,y_end", "Name,X1,Y1,X2,Y2"}) {
    const auto fractures = read(headings + "\n7,0.5,250,1.5,0.75\n9,-1,0,1e-1,3\n");
    ASSERT_EQ(fractures.size(), 2u) << headings;
    EXPECT_EQ(fractures[0].name, "7");
    EXPECT_EQ(fractures[1].points, (std::vector<Point>{Point(-1, 0), Point(0.1, 3)}));
    EXPECT_EQ(fractures[1].origin.line, 3);
    EXPECT_TRUE(fractures[0].values.empty());
  }
  EXPECT_THAT(mistake("# mapped in 2020, by hand, twice, in rain\n0,1,2,3\n"), ::testing::HasSubstr("has no headings"));
}

TEST_F(FractureTables, MayBeGeoJson) {
  const auto fractures = read(R"({"type": "FeatureCollection",
"crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::3067"}},
"features": [
	{"type": "Feature", "properties": {"name": "north", "friction": 0.4, "aperture[mm]": 2, "size[cm]": 5, "rock": "granite"},
   "geometry": {"type": "LineString", "coordinates": [[1.5, 2, 77.0], [3e0, -4.25, 77.0]]}},
  {"type": "Feature", "id": 12, "properties": null,
   "geometry": {"type": "MultiLineString", "coordinates": [[[0, 0], [1, 0], [1, 0], [1, 2]], [[5, 5], [6, 7]]]}},
  {"type": "Feature", "properties": {}, "geometry": null},
  {"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": [[0, 9], [1, 9]]}}]})",
                              "f.geojson");
  ASSERT_EQ(fractures.size(), 4u);
  EXPECT_EQ(fractures[0].name, "north");
  EXPECT_EQ(fractures[0].points, (std::vector<Point>{Point(1.5, 2), Point(3, -4.25)}));
  EXPECT_EQ(fractures[0].origin.line, 4);
  EXPECT_DOUBLE_EQ(*fractures[0].size, 0.05);
  ASSERT_EQ(fractures[0].values.size(), 2u);
  EXPECT_EQ(fractures[0].values[1].column, "aperture");
  EXPECT_EQ(fractures[0].values[1].unit, "mm");
  EXPECT_EQ(fractures[1].name, "12_1");
  EXPECT_EQ(fractures[1].points, (std::vector<Point>{Point(0, 0), Point(1, 0), Point(1, 2)}));
  EXPECT_EQ(fractures[2].name, "12_2");
  EXPECT_EQ(fractures[3].name, "set_3");
  require_used_columns(fractures, {"friction"});  // nobody takes the aperture
}

TEST_F(FractureTables, OfGeoJsonSayWhatIsWrongAndWhere) {
  const auto with = [](const std::string& geometry) {
    return "{\"type\": \"FeatureCollection\", \"features\": [\n{\"type\": \"Feature\", \"geometry\": " + geometry +
           "}]}";
  };
  EXPECT_THAT(mistake_of_json(with(R"({"type": "Point", "coordinates": [1, 2]})")),
              ::testing::StartsWith("f.geojson:2:33: a 'Point' is no fracture"));
  EXPECT_THAT(mistake_of_json(with(R"({"type": "LineString", "coordinates": [[1, 2], [3]]})")),
              ::testing::HasSubstr("a position has fewer than 2 coordinates"));
  EXPECT_THAT(mistake_of_json(with(R"({"type": "LineString", "coordinates": [[1, 2], [3, "x"]]})")),
              ::testing::HasSubstr("'x' is not a finite number"));
  EXPECT_THAT(mistake_of_json(R"({"type": "FeatureCollection", "features": []})"),
              ::testing::StartsWith("scene.yaml:3: the file 'f.geojson' holds no fracture"));
  EXPECT_THAT(mistake_of_json(R"({"type": "FeatureCollection",
"crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:OGC:1.3:CRS84"}}, "features": []})"),
              ::testing::StartsWith("f.geojson:2:8: the coordinates are degrees"));
  EXPECT_THAT(mistake_of_json(with(R"({"type": "GeometryCollection", "geometries": []})")),
              ::testing::StartsWith("f.geojson:2:33: a 'GeometryCollection' is no fracture"));
  for (const char* text : {"[1, 2]", ""})
    EXPECT_THAT(mistake_of_json(text), ::testing::StartsWith("scene.yaml:3: the file 'f.geojson' is no GeoJSON"));
}

TEST_F(FractureTables, HaveAnOriginOfTheirOwn) {
  std::ofstream(folder_ / "f.csv") << "x1,y1,x2,y2\n420001,6670002,420003,6670004.5\n";
  const auto fractures =
      read_fracture_table({"f.csv", folder_.string(), "set", {"scene.yaml", 3}, Point(420000, 6670000)});
  EXPECT_EQ(fractures[0].points, (std::vector<Point>{Point(1, 2), Point(3, 4.5)}));
}

TEST(ClippedFractures, AreTheirPartsInTheBox) {
  const Box box{Point(0, 0), Point(10, 5), {}};
  const auto parts_of = [&](std::vector<Point> points) {
    std::vector<std::vector<Point>> parts;
    for (const FractureGeometry& part : clipped({"f", std::move(points), std::nullopt, {}}, box))
      parts.push_back(part.points);
    return parts;
  };
  using Parts = std::vector<std::vector<Point>>;
  EXPECT_EQ(parts_of({{1, 1}, {2, 3}, {4, 4}}), (Parts{{{1, 1}, {2, 3}, {4, 4}}}));
  EXPECT_EQ(parts_of({{-5, 0}, {5, 10}}), Parts());  // passes the corner (0, 5)
  EXPECT_EQ(parts_of({{-5, -1}, {15, -1}}), Parts());
  EXPECT_EQ(parts_of({{2, 0}, {7, 0}}), Parts());  // along a side
  EXPECT_EQ(parts_of({{-2, 2}, {12, 2}}), (Parts{{{0, 2}, {10, 2}}}));
  EXPECT_EQ(parts_of({{2, 4}, {3, 6}, {5, 2}}), (Parts{{{2, 4}, {2.5, 5}}, {{3.5, 5}, {5, 2}}}));
  EXPECT_EQ(parts_of({{2, 4}, {2, 5}, {5, 2}}),
            (Parts{{{2, 4}, {2, 5}, {5, 2}}}));  // touches a side: validate_geometry says so
  const auto named = clipped({"f", {{2, 4}, {3, 6}, {5, 2}}, std::nullopt, {}}, box);
  EXPECT_EQ(named[0].name, "f_1");
  EXPECT_EQ(named[1].name, "f_2");
  EXPECT_EQ(clipped({"f", {{-2, 2}, {12, 2}}, std::nullopt, {}}, box)[0].name, "f");
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
