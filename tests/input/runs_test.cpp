// Runs that end, that are continued, interrupted, and that fail.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "tests/input/program.hpp"

namespace sprekk::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// The tutorial's scene with a coarser mesh and `step` hours a step.
std::vector<std::string> tutorial_run(const std::string& step, const std::vector<std::string>& more) {
  std::vector<std::string> arguments = {"run",   config("tutorial/first_scene.yaml"),
                                        "--set", "mesh={size: 1.5 m, fracture_size: 0.4 m}",
                                        "--set", "time.step=" + step};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

long rows(const fs::path& table) {
  const std::string text = text_of(table);
  return std::count(text.begin(), text.end(), '\n') - 1;
}

TEST(Run, WritesItsResults) {
  const Folder folder;
  const Outcome outcome = sprekk_command(tutorial_run("12 h", {"-o", "results"}), folder.path());
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const std::string file : {"run.json", "history.csv", "coupling.csv", "checkpoint.h5"})
    EXPECT_TRUE(fs::exists(folder / ("results/" + file))) << file;
  EXPECT_EQ(rows(folder / "results/history.csv"), 4);
  const nlohmann::json record = nlohmann::json::parse(text_of(folder / "results/run.json"));
  EXPECT_THAT(record.dump(), HasSubstr("time.step"));
}

TEST(Run, GoesIntoResultsUnderTheNameOfTheScene) {
  const Folder folder;
  ASSERT_EQ(sprekk_command(tutorial_run("24 h", {"-q"}), folder.path()).code, 0);
  ASSERT_EQ(sprekk_command(tutorial_run("24 h", {"-q"}), folder.path()).code, 0);
  EXPECT_TRUE(fs::exists(folder / "results/first_scene/history.csv"));
  EXPECT_TRUE(fs::exists(folder / "results/first_scene-2/history.csv"));
}

void expect_same_bits_in_halves(const std::vector<std::string>& settings) {
  const Folder folder;
  const auto run = [&](std::vector<std::string> more) {
    more.insert(more.end(), settings.begin(), settings.end());
    return sprekk_command(tutorial_run("4 h", more), folder.path());
  };
  ASSERT_EQ(run({"-q", "-o", "whole"}).code, 0);
  ASSERT_EQ(run({"-q", "-o", "parts", "--set", "time.end=1 day"}).code, 0);
  EXPECT_EQ(rows(folder / "parts/history.csv"), 6);
  const Outcome rest = run({"-q", "-o", "parts", "--restart"});
  ASSERT_EQ(rest.code, 0) << rest.err;
  EXPECT_EQ(rows(folder / "whole/history.csv"), 12);
  EXPECT_EQ(text_of(folder / "parts/history.csv"), text_of(folder / "whole/history.csv"));
  EXPECT_EQ(text_of(folder / "parts/coupling.csv"), text_of(folder / "whole/coupling.csv"));
}

TEST(Run, ContinuedFromItsHalfHasTheSameBits) { expect_same_bits_in_halves({}); }

/// Two jump where the second half begins.
TEST(Run, WithPropertiesThatChangeContinuedFromItsHalfHasTheSameBits) {
  expect_same_bits_in_halves({"--set", "materials.permeability=(1e-18*(1 + t/day)) m^2", "--set",
                              "materials.young_modulus=[{value: 20 GPa}, {value: -5 GPa, from: 1 day}]", "--set",
                              "materials.biot_coefficient=0.8 - 0.1*t/day", "--set",
                              "materials.fluid_compressibility=(4e-10*(1 + t/day)) 1/Pa", "--set",
                              "materials.viscosity=[{value: 1 mPa*s, to: 1 day}, {value: 2 mPa*s, from: 1 day}]",
                              "--set", "materials.friction=0.6 - 0.1*t/day"});
}

TEST(Run, WithFracturesThatMeetContinuedFromItsHalfHasTheSameBits) {
  expect_same_bits_in_halves({"--set", "geometry.fractures.crossing={points: [[4.2 m, 3.1 m], [5.6 m, 2.8 m]]}",
                              "--set", "geometry.fractures.touching={points: [[5.5 m, 3.5 m], [6.3 m, 3.2 m]]}"});
}

TEST(Run, InterruptedAndContinuedHasTheSameBits) {
  const Folder folder;
  const std::string step = "10 min";  // 288 steps: long enough to be interrupted
  ASSERT_EQ(sprekk_command(tutorial_run(step, {"-q", "-o", "whole"}), folder.path()).code, 0);

  Program program(tutorial_run(step, {"-o", "parts"}), folder.path());
  while (rows(folder / "parts/history.csv") < 5 && program.is_running())
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  program.interrupt();
  const Outcome interrupted = program.wait();
  ASSERT_EQ(interrupted.code, 130) << interrupted.err;
  EXPECT_THAT(interrupted.err, HasSubstr("interrupted"));
  EXPECT_THAT(interrupted.err, HasSubstr("parts/checkpoint.h5"));
  EXPECT_TRUE(fs::exists(folder / "parts/checkpoint.h5"));
  EXPECT_LT(rows(folder / "parts/history.csv"), 288);

  const Outcome rest = sprekk_command(tutorial_run(step, {"-q", "--restart", "parts/checkpoint.h5"}), folder.path());
  ASSERT_EQ(rest.code, 0) << rest.err;
  EXPECT_EQ(rows(folder / "whole/history.csv"), 288);
  EXPECT_EQ(text_of(folder / "parts/history.csv"), text_of(folder / "whole/history.csv"));
}

TEST(Run, ThatFailsSaysWhyAndKeepsItsLastStep) {
  // The pressure of the side has no value from 45 to 75 minutes, which the first and the last step do not meet.
  const Folder folder;
  const Outcome outcome = sprekk_command(
      {"run", std::string(SPREKK_SOURCE_DIR) + "/tests/input/base/flow.yaml", "--set", "time={end: 2 h, step: 30 min}",
       "--set", "components.pore.boundary.right.pressure='(sqrt(abs(t - 3600) - 900)) kPa'", "-o", "results"},
      folder.path());
  EXPECT_EQ(outcome.code, 1);
  for (const std::string text : {"the step from", "has no data", "sqrt(abs(t - 3600) - 900)", "results/checkpoint.h5"})
    EXPECT_THAT(outcome.err, HasSubstr(text));
  EXPECT_TRUE(fs::exists(folder / "results/checkpoint.h5"));
  EXPECT_EQ(rows(folder / "results/history.csv"), 1);
  EXPECT_EQ(nlohmann::json::parse(text_of(folder / "results/run.json")).at("exit").at("code"), 1);
}

TEST(Run, TakesTheValueOfAWindowUntilItsEnd) {
  // Without storage the pressure follows its sides at once: 1 MPa in the window, that is until and in the step that
  // ends with it, and 0 afterwards.
  const Folder folder;
  const Outcome outcome = sprekk_command(
      {"run", std::string(SPREKK_SOURCE_DIR) + "/tests/input/base/flow.yaml", "--set", "components.pore.storage=0 1/Pa",
       "--set", "components.pore.boundary.left=null", "--set",
       "components.pore.boundary.right.pressure={value: 1 MPa, from: 0 s, to: 45 min}", "-q", "-o", "results"},
      folder.path());
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  std::vector<double> times, pressures;
  std::istringstream lines(text_of(folder / "results/history.csv"));
  std::string line;
  std::getline(lines, line);
  std::vector<std::string> headings;
  std::istringstream heading(line);
  for (std::string name; std::getline(heading, name, ',');) headings.push_back(name);
  const auto column = std::find(headings.begin(), headings.end(), "p[Pa]") - headings.begin();
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::string cell;
    for (long i = 0; std::getline(cells, cell, ','); ++i) {
      if (i == 0) times.push_back(std::stod(cell));
      if (i == column) pressures.push_back(std::stod(cell));
    }
  }
  EXPECT_EQ(times, (std::vector<double>{1800, 2700, 3600}));
  ASSERT_EQ(pressures.size(), 3U);
  EXPECT_NEAR(pressures[0], 1e6, 1e-3);
  EXPECT_NEAR(pressures[1], 1e6, 1e-3);
  EXPECT_NEAR(pressures[2], 0, 1e-3);
}

}  // namespace
}  // namespace sprekk::testing
