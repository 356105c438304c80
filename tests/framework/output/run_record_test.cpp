#include "framework/output/run_record.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/framework/output/small_case.hpp"

namespace sprekk {
namespace {

using nlohmann::json;
using RunRecordTest = TemporaryFolder;

TEST_F(RunRecordTest, HoldsWhatItWasGiven) {
  RunRecord record;
  record.scene_name = "mandel";
  record.scene_files = {"mandel.yaml", "finer.yaml"};
  record.scene_text = "components:\n  pore: {type: matrix_flow/mpfa}\n";
  record.parameters = {{"components.pore.permeability", "1e-15 m^2", "mandel.yaml:3:5"}};
  record.blas = "OpenBLAS";
  record.processes = 2;
  record.exit_code = 0;
  record.exit_reason = "done";
  record.seconds = 1.0 / 3;
  record.timings["mesh"] = 0.25;
  record.counters["steps accepted"] = 12;
  record.results["well.pressure[Pa]"] = 0.1 + 0.2;
  record.notes = {{"floor", "three cells were floored", 0.1, 1.0 / 3, 4}};
  Profile profile;
  profile.at("pore") = {"pore", 1, 2, 3, 0.5};
  record.write(folder / "run.json", profile);

  const json read = json::parse(read_text(folder / "run.json"));
  EXPECT_EQ(read["scene"]["name"], "mandel");
  EXPECT_EQ(read["scene"]["files"], json({"mandel.yaml", "finer.yaml"}));
  EXPECT_EQ(read["scene"]["text"], record.scene_text);
  EXPECT_EQ(read["scene"]["parameters"]["components.pore.permeability"]["value"], "1e-15 m^2");
  EXPECT_EQ(read["scene"]["parameters"]["components.pore.permeability"]["origin"], "mandel.yaml:3:5");
  EXPECT_EQ(read["program"]["blas"], "OpenBLAS");
  EXPECT_EQ(read["host"]["processes"], 2);
  EXPECT_EQ(read["exit"], (json{{"code", 0}, {"reason", "done"}}));
  EXPECT_EQ(read["seconds"].get<double>(), 1.0 / 3);
  EXPECT_EQ(read["timings"]["mesh"], 0.25);
  EXPECT_EQ(read["counters"]["steps accepted"], 12);
  EXPECT_EQ(read["results"]["well.pressure[Pa]"].get<double>(), 0.1 + 0.2);
  EXPECT_EQ(read["notes"][0], (json{{"topic", "floor"},
                                    {"text", "three cells were floored"},
                                    {"first_time", 0.1},
                                    {"last_time", 1.0 / 3},
                                    {"steps", 4}}));
  EXPECT_EQ(read["profile"][0], (json{{"name", "pore"}, {"calls", 1}, {"reuses", 2}, {"skips", 3}, {"seconds", 0.5}}));
}

TEST_F(RunRecordTest, ABareRecordSaysThatTheRunGoesOnAndWhatRunsIt) {
  const json read = json::parse(RunRecord().json(Profile()));
  EXPECT_EQ(read["exit"]["reason"], "running");
  EXPECT_GE(read["host"]["cores"], 1);
  for (const char* key : {"version", "git_commit", "compiler", "build_type", "libraries", "blas"})
    EXPECT_TRUE(read["program"].contains(key)) << key;
  EXPECT_TRUE(read["results"].is_object());
  EXPECT_TRUE(read["profile"].is_array());
}

TEST_F(RunRecordTest, NumbersAndTextThatJsonCannotHoldDoNotPreventIt) {
  RunRecord record;
  record.results["a"] = std::nan("");
  record.notes = {{"bytes", "bad byte \xff here"}};
  const json read = json::parse(record.json(Profile()));
  EXPECT_TRUE(read["results"]["a"].is_null());
  EXPECT_EQ(read["notes"].size(), 1u);
}

}  // namespace
}  // namespace sprekk
