// Runs whose fractures grow, interrupted and continued.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/input/program.hpp"

namespace sprekk::testing {
namespace {

namespace fs = std::filesystem;

/// Section 5.2 of the paper on a coarse mesh and with a low toughness, so that wings soon grow; the mesh follows every
/// 5 mm.
std::vector<std::string> growing_run(const std::vector<std::string>& more) {
  std::vector<std::string> arguments = {"run", config("paper/wing_cracks.yaml")};
  for (const std::string value :
       {"mesh={size: 0.5 m, fracture_size: 25 mm}", "components.tips.toughness=0.42 MPa*m^0.5",
        "components.tips.size=0.3 m", "components.tips.sectors=8", "components.tips.mesh_ratio=1",
        "components.tips.growth={increment: 5 mm}", "couplers.4.propagation_threshold=0.2",
        "schedule.1.update=after_step", "components.conduit.injection.well.rate=4.0e-8 m^2/s", "time.step=10 min",
        "time.end=40 s"}) {
    arguments.push_back("--set");
    arguments.push_back(value);
  }
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

long rows(const fs::path& table) {
  const std::string text = text_of(table);
  return std::count(text.begin(), text.end(), '\n') - 1;
}

/// Of the last program that worked in this folder.
long mesh_changes(const fs::path& folder) {
  const nlohmann::json counters = nlohmann::json::parse(text_of(folder / "run.json")).at("counters");
  return counters.value("changes of the mesh", 0L);
}

void expect_same_bits_in_parts(const std::vector<std::string>& settings) {
  const Folder folder;
  const auto growing = [&](std::vector<std::string> more) {
    more.insert(more.end(), settings.begin(), settings.end());
    return growing_run(more);
  };
  const Outcome whole = sprekk_command(growing({"-q", "-o", "whole"}), folder.path());
  ASSERT_EQ(whole.code, 0) << whole.err;
  const long changes = mesh_changes(folder / "whole"), all = rows(folder / "whole/history.csv");
  ASSERT_GE(changes, 2);

  // Interrupted while the fine level has a path of its own, and again after the mesh has changed.
  std::vector<std::string> arguments = growing({"-q", "-o", "parts"});
  long changes_in_parts = 0;
  for (const long until : {all / 3, 2 * all / 3}) {
    Program program(arguments, folder.path());
    while (rows(folder / "parts/history.csv") < until && program.is_running())
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    program.interrupt();
    const Outcome interrupted = program.wait();
    ASSERT_EQ(interrupted.code, 130) << interrupted.err;
    changes_in_parts += mesh_changes(folder / "parts");
    arguments = growing({"-q", "--restart", "parts/checkpoint.h5"});
  }
  EXPECT_GE(changes_in_parts, 1);
  EXPECT_LT(changes_in_parts, changes);
  const Outcome rest = sprekk_command(arguments, folder.path());
  ASSERT_EQ(rest.code, 0) << rest.err;
  EXPECT_EQ(changes_in_parts + mesh_changes(folder / "parts"), changes);
  EXPECT_EQ(text_of(folder / "parts/history.csv"), text_of(folder / "whole/history.csv"));
}

// Between two increments the state contains how fast loads have risen, and that the onset of a tip is over. A restart
// that loses one of them takes other steps from there on: so this run is interrupted after every step or two.
TEST(RunWithGrowth, InterruptedAgainAndAgainHasTheSameBits) {
  const Folder folder;
  const auto growing = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"--set", "time.end=45 s", "--set", "time.step=10 s", "-q"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return growing_run(arguments);
  };
  const Outcome whole = sprekk_command(growing({"-o", "whole"}), folder.path());
  ASSERT_EQ(whole.code, 0) << whole.err;
  ASSERT_GE(mesh_changes(folder / "whole"), 3);
  std::vector<std::string> arguments = growing({"-o", "parts"});
  int interruptions = 0;
  for (long before = 0;; before = rows(folder / "parts/history.csv")) {
    Program program(arguments, folder.path());
    while (rows(folder / "parts/history.csv") <= before && program.is_running())
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    program.interrupt();
    const Outcome part = program.wait();
    if (part.code == 0) break;
    ASSERT_EQ(part.code, 130) << part.err;
    ++interruptions;
    arguments = growing({"--restart", "parts/checkpoint.h5"});
  }
  EXPECT_GE(interruptions, rows(folder / "whole/history.csv") / 3);
  EXPECT_EQ(text_of(folder / "parts/history.csv"), text_of(folder / "whole/history.csv"));
}

TEST(RunWithGrowth, TheTimesOfBothLevelsAddUp) {
  const Folder folder;
  // With the contact in between, a solve of the fine level has many back-solves: those of its walls.
  const Outcome run = sprekk_command(
      growing_run({"-o", "results", "--set", "couplers.4.between=[rock, conduit, tips]"}), folder.path());
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("factorizations, back-solves"), std::string::npos);
  const nlohmann::json record = nlohmann::json::parse(text_of(folder / "results/run.json"));
  double solvers = 0, timed = 0;
  std::map<std::string, long> calls;
  for (const nlohmann::json& entry : record.at("profile")) {
    const std::string name = entry.at("name");
    const double seconds = entry.at("seconds");
    EXPECT_GE(seconds, 0) << name;
    timed += seconds;
    calls[name] = entry.at("calls");
    if (name.starts_with("linear: ") || name == "tips: ordering" || name == "tips: factorization" ||
        name == "tips: back-solves")
      solvers += seconds;
  }
  const nlohmann::json& timings = record.at("timings");
  const double whole = record.at("seconds"), written = 1e-9;
  EXPECT_NEAR(timings.at("factorizations, back-solves"), solvers, written);
  EXPECT_NEAR(timings.at("everything else").get<double>() + solvers, whole, written);
  EXPECT_LE(timed, whole);
  const nlohmann::json& counters = record.at("counters");
  EXPECT_GT(calls["tips: mesh"], 0);
  EXPECT_EQ(calls["tips: mesh"], counters.at("tips: meshes"));
  EXPECT_EQ(calls["tips: factorization"], counters.at("tips: meshes"));
  EXPECT_EQ(calls["tips: back-solves"], counters.at("tips: solves"));
}

TEST(RunWithGrowth, InterruptedAndContinuedHasTheSameBits) { expect_same_bits_in_parts({}); }

TEST(RunWithGrowth, WithFracturesThatCrossInterruptedAndContinuedHasTheSameBits) {
  expect_same_bits_in_parts(
      {"--set", "geometry.fractures.crossing={center: [1 m, 1 m], length: 0.05 m, angle: 135 deg}"});
}

TEST(RunWithGrowth, WithPropertiesThatChangeInterruptedAndContinuedHasTheSameBits) {
  expect_same_bits_in_parts({"--set", "materials.young_modulus=(40e9*(1 - t/(20*min))) Pa", "--set",
                             "materials.permeability=(5e-20*(1 + t/min)) m^2", "--set",
                             "materials.biot_coefficient=0.8 - 0.01*t/min", "--set",
                             "materials.friction=0.5 - 0.01*t/min"});
}

}  // namespace
}  // namespace sprekk::testing
