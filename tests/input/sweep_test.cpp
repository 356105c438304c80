// Studies: `sprekk sweep`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "tests/input/program.hpp"

namespace sprekk::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const std::string compare =
    "compare: {plot: [injection_pressure], table: {final: {of: injection_pressure, at: end}}}\n";

/// A study of the tutorial's scene on a coarse mesh.
void write_study(const Folder& folder, const std::string& runs) {
  fs::copy_file(config("tutorial/first_scene.yaml"), folder / "scene.yaml", fs::copy_options::skip_existing);
  std::ofstream(folder / "study.yaml")
      << "scene: scene.yaml\nset: {mesh.size: 1.5 m, mesh.fracture_size: 0.4 m, output.every: 2 day}\n"
      << runs << compare;
}

Outcome sweep(const Folder& folder, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {"sweep", "study.yaml", "-j", "2"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return sprekk_command(arguments, folder.path());
}

long rows(const fs::path& table) {
  const std::string text = text_of(table);
  return std::count(text.begin(), text.end(), '\n') - 1;
}

nlohmann::json run_of(const Folder& folder, const std::string& name) {
  const nlohmann::json record = nlohmann::json::parse(text_of(folder / "results/study/sweep.json"));
  for (const auto& run : record.at("runs"))
    if (run.at("name") == name) return run;
  return {};
}

TEST(Sweep, RunsAllAndComparesThem) {
  const Folder folder;
  write_study(folder, "grid: {time.step: [12 h, 24 h]}\nruns: {fine: {time.step: 8 h}}\n");
  const Outcome outcome = sweep(folder);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const std::string text : {"[1/3] ", "[3/3] ", "3 runs"}) EXPECT_THAT(outcome.err, HasSubstr(text));
  EXPECT_EQ(rows(folder / "results/study/step=12h/history.csv"), 4);
  EXPECT_EQ(rows(folder / "results/study/fine/history.csv"), 6);
  EXPECT_EQ(rows(folder / "results/study/sweep.csv"), 3);
  EXPECT_THAT(text_of(folder / "results/study/sweep.csv"), HasSubstr("run,time.step,final[Pa],state,exit_code[1],"));
  EXPECT_THAT(text_of(folder / "results/study/sweep.svg"), HasSubstr("step=24h"));
  // The figure is the last value of the run's own history.
  const nlohmann::json record = nlohmann::json::parse(text_of(folder / "results/study/fine/run.json"));
  EXPECT_EQ(run_of(folder, "fine").at("figures").at("final[Pa]"), record.at("results").at("injection_pressure[Pa]"));
}

TEST(Sweep, DoesNotRepeatWhatIsDoneAndAddsWhatIsNew) {
  const Folder folder;
  write_study(folder, "grid: {time.step: [12 h]}\n");
  ASSERT_EQ(sweep(folder).code, 0);
  const auto written = fs::last_write_time(folder / "results/study/step=12h/run.json");
  write_study(folder, "grid: {time.step: [12 h, 24 h]}\n");
  EXPECT_THAT(sweep(folder, {"--list"}).out, HasSubstr("keep   step=12h\nstart  step=24h\n"));
  const Outcome outcome = sweep(folder);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("1 done before"));
  EXPECT_EQ(fs::last_write_time(folder / "results/study/step=12h/run.json"), written);
  EXPECT_EQ(rows(folder / "results/study/sweep.csv"), 2);
}

TEST(Sweep, NeverOverwritesARunOfOtherValues) {
  const Folder folder;
  write_study(folder, "runs: {a: {time.end: 12 h, time.step: 12 h}}\n");
  ASSERT_EQ(sweep(folder).code, 0);
  write_study(folder, "runs: {a: {time.end: 1 day, time.step: 12 h}}\n");
  const Outcome outcome = sweep(folder);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("results/study/a holds a run of other values"));
  EXPECT_EQ(rows(folder / "results/study/a/history.csv"), 1);
}

TEST(Sweep, GoesOnWhereItWasInterruptedWithTheSameBits) {
  const Folder folder;
  write_study(folder, "grid: {time.step: [10 min, 11 min, 12 min]}\n");  // 288 steps: long enough to be interrupted
  ASSERT_EQ(sweep(folder, {"-o", "whole"}).code, 0);

  Program program({"sweep", "study.yaml", "-j", "2"}, folder.path());
  while (rows(folder / "results/study/step=10min/history.csv") < 5 && program.is_running())
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  program.interrupt();
  const Outcome interrupted = program.wait();
  ASSERT_EQ(interrupted.code, 130) << interrupted.err;
  EXPECT_EQ(run_of(folder, "step=10min").at("state"), "interrupted");
  EXPECT_LT(rows(folder / "results/study/step=10min/history.csv"), 288);
  EXPECT_FALSE(fs::exists(folder / "results/study/step=12min")) << "a run was started after the interrupt";

  const Outcome rest = sweep(folder);
  ASSERT_EQ(rest.code, 0) << rest.err;
  EXPECT_THAT(rest.err, HasSubstr(" to go on"));
  for (const std::string run : {"step=10min", "step=11min", "step=12min"})
    EXPECT_EQ(text_of(folder / ("results/study/" + run + "/history.csv")),
              text_of(folder / ("whole/" + run + "/history.csv")));
}

TEST(Sweep, GoesOnWithTheOthersWhenARunFails) {
  // The pressure of the side has no value from 22 to 26 hours, which the first and the last step do not meet.
  const Folder folder;
  write_study(folder,
              "runs:\n  bad: {time.step: 12 h, components.pore.boundary.left.pressure: "
              "'(sqrt(abs(t - 86400) - 7200)) kPa'}\n  good: {time.step: 24 h}\n");
  const Outcome outcome = sweep(folder);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("bad: failed ("));
  EXPECT_THAT(outcome.err, HasSubstr("has no data"));
  EXPECT_EQ(run_of(folder, "good").at("state"), "done");
  EXPECT_EQ(run_of(folder, "bad").at("exit_code"), 1);
  EXPECT_THAT(text_of(folder / "results/study/sweep.csv"), HasSubstr("has no data"));
}

TEST(Sweep, RefusesMistakesBeforeAnyRun) {
  const Folder folder;
  const auto refused = [&](const std::string& runs, const std::string& message) {
    write_study(folder, runs);
    const Outcome outcome = sweep(folder);
    EXPECT_EQ(outcome.code, 2) << runs;
    EXPECT_THAT(outcome.err, HasSubstr(message));
    EXPECT_FALSE(fs::exists(folder / "results"));
  };
  refused("grid: {time.stepp: [1 h]}\n", "study.yaml:3:8: unknown key 'stepp' in 'time'");
  write_study(folder, "runs: {a: }\n");
  std::string text = text_of(folder / "study.yaml");
  text.replace(text.find("of: injection"), 13, "of: injektion");
  std::ofstream(folder / "study.yaml") << text;
  const Outcome outcome = sweep(folder);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("unknown column of history.csv 'injektion_pressure'"));
  EXPECT_THAT(outcome.err, HasSubstr("did you mean 'injection_pressure'?"));
  EXPECT_FALSE(fs::exists(folder / "results"));
}

}  // namespace
}  // namespace sprekk::testing
