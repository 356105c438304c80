#include "framework/report/map_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace sprekk {
namespace {

using testing::ElementsAre;

RunResults::Written written(double time) {
  RunResults::Written result{time, {}, {}};
  result.matrix.points = {{0, 0}, {1, 0}, {0, 1}};
  result.matrix.cells = {0, 1, 2};
  result.matrix.points_per_cell = 3;
  result.matrix.arrays = {{"region", Grid::Place::cell, 1, {0}},
                          {"a.velocity[m/s]", Grid::Place::cell, 3, {3, 4, 0}, {"x", "y", "z"}},
                          {"a.stress[Pa]", Grid::Place::cell, 3, {1, 2, 0}, {"xx", "yy", "xy"}},
                          {"a.p[Pa]", Grid::Place::point, 1, {0, 1e6, time}}};
  return result;
}

std::vector<std::string> labels(const RunResults& results) {
  std::vector<std::string> all;
  for (const MapField& field : map_fields(results)) all.push_back(field.label);
  return all;
}

TEST(MapFields, are_scalars_first_and_parts_of_vectors_and_tensors) {
  RunResults results;
  results.written = {written(1)};
  EXPECT_THAT(labels(results), ElementsAre("a.p", "a.velocity, length", "a.velocity, x", "a.velocity, y",
                                           "a.stress, xx", "a.stress, yy", "a.stress, xy", "region"));
}

TEST(MapJson, writes_a_mesh_once_and_ranges_over_all_times) {
  RunResults results;
  results.written = {written(-2e6), written(3e6)};
  const auto data = nlohmann::json::parse(map_json(results));
  EXPECT_EQ(data["meshes"].size(), 1U);
  EXPECT_EQ(data["times"].size(), 2U);
  EXPECT_EQ(data["fields"][0]["unit"], "MPa");
  EXPECT_EQ(data["fields"][0]["low"], -2.0);
  EXPECT_EQ(data["fields"][0]["high"], 3.0);
  EXPECT_EQ(data["fields"][0]["onPoints"], true);
  EXPECT_DOUBLE_EQ(data["fields"][1]["high"], 5);
  // 0, 1 and 3 MPa between -2 and 3: two fifths, three fifths and all of 65535, little-endian.
  EXPECT_EQ(data["times"][1]["values"][0], "ZmaZmf//");
}

TEST(MapJson, has_fractures_and_what_they_have_grown_beyond_the_mesh) {
  const auto line = [](std::array<double, 2> from, std::array<double, 2> to) {
    Grid grid;
    grid.points = {from, to};
    grid.cells = {0, 1};
    grid.points_per_cell = 2;
    return grid;
  };
  RunResults results;
  results.written = {written(0), written(1)};
  for (RunResults::Written& at : results.written) at.fractures = line({0, 0}, {0.5, 0});
  results.written[1].paths = line({0.5, 0}, {0.75, 0.25});
  const auto data = nlohmann::json::parse(map_json(results));
  EXPECT_EQ(data["times"][0]["lines"], nlohmann::json::parse("[[0, 0, 0.5, 0]]"));
  EXPECT_EQ(data["times"][1]["lines"], nlohmann::json::parse("[[0, 0, 0.5, 0], [0.5, 0, 0.75, 0.25]]"));
}

TEST(MapJson, has_what_colours_fractures_and_their_names) {
  RunResults results;
  results.record = R"({"scene": {"fractures": ["joint", "fault"]}})";
  results.written = {written(0), written(1)};
  for (double slip : {1e-3, 5e-3}) {
    Grid& grid = results.written[slip > 2e-3].fractures;
    grid.points = {{0, 0}, {0.5, 0}, {0.5, 0.5}};
    grid.cells = {0, 1, 1, 2};
    grid.points_per_cell = 2;
    grid.arrays = {{"fracture", Grid::Place::cell, 1, {0, 1}},
                   {"a.slip[m]", Grid::Place::cell, 1, {0, slip}},
                   {"a.pair[m]", Grid::Place::cell, 3, {0, 0, 0, 0, 0, 0}}};
  }
  const auto data = nlohmann::json::parse(map_json(results));
  EXPECT_EQ(data["names"], nlohmann::json::parse(R"(["joint", "fault"])"));
  ASSERT_EQ(data["lineFields"].size(), 1U);
  EXPECT_EQ(data["lineFields"][0]["label"], "a.slip");
  EXPECT_EQ(data["lineFields"][0]["unit"], "mm");
  EXPECT_EQ(data["lineFields"][0]["high"], 5.0);
  // 0 and 1 mm between 0 and 5: nothing and a fifth of 65535, 0x3333, little-endian; then nothing and all.
  EXPECT_EQ(data["times"][0]["lineValues"][0], "AAAzMw==");
  EXPECT_EQ(data["times"][1]["lineValues"][0], "AAD//w==");
  EXPECT_EQ(data["times"][1]["fracture"], "AAABAA==");
}

TEST(MapJson, takes_fewer_times_of_a_large_run) {
  RunResults results;
  for (int i = 0; i < 10; ++i) results.written.push_back(written(i));
  const auto data = nlohmann::json::parse(map_json(results, 400));
  EXPECT_LT(data["times"].size(), 10U);
  EXPECT_EQ(data["times"].back()["text"], "9 s");
}

}  // namespace
}  // namespace sprekk
