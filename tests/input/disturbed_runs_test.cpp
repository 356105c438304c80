// Runs that meet a full disk, another run, signals, and files that are not what they should be.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>
#include <tuple>

#include "tests/input/program.hpp"

namespace sprekk::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using Clock = std::chrono::steady_clock;

const std::string flow = std::string(SPREKK_SOURCE_DIR) + "/tests/input/base/flow.yaml";

/// The tutorial's scene with a coarser mesh.
std::vector<std::string> tutorial(const std::vector<std::string>& more, const std::string& sizes = "1.5 m, 0.4 m") {
  const std::size_t comma = sizes.find(',');
  std::vector<std::string> arguments = {
      "run", config("tutorial/first_scene.yaml"), "--set",
      "mesh={size: " + sizes.substr(0, comma) + ", fracture_size:" + sizes.substr(comma + 1) + "}"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

std::string tutorial_line(const std::string& more) {
  return "\"$sprekk\" run " + config("tutorial/first_scene.yaml") +
         " --set 'mesh={size: 1.5 m, fracture_size: 0.4 m}' --set output.fields=false " + more;
}

long rows(const fs::path& table) {
  const std::string text = text_of(table);
  return std::max<long>(0, std::count(text.begin(), text.end(), '\n') - 1);
}

template <class Condition>
void wait_until(Program& program, const Condition& condition) {
  while (!condition() && program.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

// A limit for files does what a full disk does: every writer fails beyond it.

TEST(FullDisk, EndsARunWithAMessageAndKeepsTheCheckpoint) {
  for (const std::string trap : {"trap '' XFSZ; ", ""}) {
    const Folder folder;
    ASSERT_EQ(shell_command(tutorial_line("-q -o u --set 'time.end=1 day'"), folder.path()).code, 0);
    const std::string before = text_of(folder / "u/checkpoint.h5");
    const Outcome full =
        shell_command(trap + "ulimit -f 40; exec " + tutorial_line("-q -o u --restart"), folder.path());
    EXPECT_EQ(full.code, 1) << full.err;
    EXPECT_THAT(full.err, AllOf(HasSubstr("cannot write u/checkpoint.h5 (File too large)"),
                                HasSubstr("go on from its last checkpoint, u/checkpoint.h5")));
    EXPECT_EQ(text_of(folder / "u/checkpoint.h5"), before);
    EXPECT_FALSE(fs::exists(folder / "u/checkpoint.h5.partial"));
    // With room again the run goes on, and nothing is missing.
    ASSERT_EQ(shell_command(tutorial_line("-q -o u --restart"), folder.path()).code, 0);
    ASSERT_EQ(shell_command(tutorial_line("-q -o whole"), folder.path()).code, 0);
    for (const std::string table : {"/history.csv", "/coupling.csv"})
      EXPECT_EQ(text_of(folder / ("u" + table)), text_of(folder / ("whole" + table)));
  }
}

TEST(FullDisk, EndsARunWhicheverWriterMeetsItFirst) {
  // In blocks of 512 or 1024 bytes: the checkpoint at the start; of a run that goes on the record, a table, fields.
  for (const auto& [blocks, file, goes_on] :
       {std::tuple(2, "u/checkpoint.h5", false), {2, "u/", true}, {26, "u/", true}, {40, "u/matrix_", true}}) {
    const Folder folder;
    const std::string run = tutorial_line("-q -o u --set output.fields=true --set 'time.step=1 h'");
    if (goes_on) {
      ASSERT_EQ(shell_command(run + " --set 'time.end=2 h'", folder.path()).code, 0);
    }
    const Outcome full = shell_command(
        "ulimit -f " + std::to_string(blocks) + "; exec " + run + (goes_on ? " --restart" : ""), folder.path());
    EXPECT_EQ(full.code, 1) << blocks << ": " << full.err;
    EXPECT_THAT(full.err, HasSubstr(std::string("cannot write ") + file)) << blocks;
  }
}

TEST(RunFolder, BelongsToOneRunAtATime) {
  const Folder folder;
  Program holder(tutorial({"-q", "-o", "v", "--set", "time.step=10 s"}), folder.path());
  wait_until(holder, [&] { return rows(folder / "v/history.csv") > 2; });
  const std::string held = text_of(folder / "v/.lock");
  EXPECT_THAT(held, HasSubstr("process "));
  const std::string table = text_of(folder / "v/history.csv");
  std::ofstream(folder / "v/checkpoint.h5") << "not yet";
  const Outcome other =
      sprekk_command(tutorial({"-q", "-o", "v", "--restart", "--set", "time.step=10 s"}), folder.path());
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.err, AllOf(HasSubstr("another run is at work in v (" + held.substr(0, held.find('\n')) + ")"),
                               HasSubstr("choose another folder with -o")));
  EXPECT_EQ(text_of(folder / "v/history.csv").substr(0, table.size()), table);
  ASSERT_TRUE(holder.is_running());
  holder.interrupt();
  EXPECT_EQ(holder.wait().code, 130);
  EXPECT_FALSE(fs::exists(folder / "v/.lock"));
}

TEST(RunFolder, OfADeadRunIsTakenOver) {
  const Folder folder;
  const std::vector<std::string> more = {"--set", "time.step=20 min", "--set",
                                         "output={checkpoint_every: 1 ms, fields: false}"};
  std::vector<std::string> arguments = {"-q", "-o", "u"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  Program dead(tutorial(arguments), folder.path());
  wait_until(dead, [&] { return rows(folder / "u/history.csv") > 5; });
  dead.signal(SIGKILL);
  EXPECT_EQ(dead.wait().code, -SIGKILL);
  EXPECT_TRUE(fs::exists(folder / "u/.lock"));
  arguments.emplace_back("--restart");
  const Outcome rest = sprekk_command(tutorial(arguments), folder.path());
  EXPECT_EQ(rest.code, 0) << rest.err;
  EXPECT_FALSE(fs::exists(folder / "u/.lock"));
  EXPECT_EQ(sprekk_command(tutorial({"-q", "-o", "whole", "--set", "time.step=20 min"}), folder.path()).code, 0);
  for (const std::string table : {"/history.csv", "/coupling.csv"})
    EXPECT_EQ(text_of(folder / ("u" + table)), text_of(folder / ("whole" + table)));
}

TEST(RunFolder, OfARunThatWasKilledInItsFirstStepGoesOn) {
  const Folder folder;
  const std::vector<std::string> outputs = {
      "--set", "output.lines={l: {of: pore.pressure, from: [1 m, 1 m], to: [2 m, 2 m], points: 3}}"};
  const auto run = [&](std::vector<std::string> more) {
    more.insert(more.end(), outputs.begin(), outputs.end());
    return tutorial(more, "0.6 m, 0.2 m");
  };
  Program dead(run({"-q", "-o", "u"}), folder.path());
  wait_until(dead, [&] { return fs::exists(folder / "u/checkpoint.h5"); });
  dead.signal(SIGKILL);
  EXPECT_EQ(dead.wait().code, -SIGKILL);
  EXPECT_EQ(rows(folder / "u/history.csv"), 0) << "within the first step";
  const Outcome anew = sprekk_command(run({"-q", "-o", "u"}), folder.path());
  EXPECT_EQ(anew.code, 2);
  EXPECT_THAT(anew.err, HasSubstr("continue the run that it holds with --restart"));
  const Outcome rest = sprekk_command(run({"-q", "-o", "u", "--restart"}), folder.path());
  EXPECT_EQ(rest.code, 0) << rest.err;
  EXPECT_EQ(sprekk_command(run({"-q", "-o", "whole"}), folder.path()).code, 0);
  for (const std::string file : {"/history.csv", "/coupling.csv", "/line_l.csv", "/matrix.pvd", "/checkpoint.h5"})
    EXPECT_TRUE(text_of(folder / ("u" + file)) == text_of(folder / ("whole" + file))) << file;
}

TEST(RunFolder, OfARunThatWasKilledBeforeThatIsStartedAgain) {
  const Folder folder;
  fs::create_directory(folder / "u");
  for (const std::string name : {".lock", "checkpoint.h5.partial"}) std::ofstream(folder / ("u/" + name)) << "cut sho";
  const Outcome outcome = sprekk_command(tutorial({"-q", "-o", "u", "--set", "time.end=12 h"}), folder.path());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_FALSE(fs::exists(folder / "u/checkpoint.h5.partial"));
}

TEST(RunFolder, LetsNoLinkLeadOutOfIt) {
  const Folder folder;
  ASSERT_EQ(sprekk_command(tutorial({"-q", "-o", "first", "--set", "time.end=1 day"}), folder.path()).code, 0);
  for (const std::string name : {"history.csv", "coupling.csv", "checkpoint.h5.partial", "run.json.partial"}) {
    const std::string outside = "outside " + name;
    fs::copy(folder / "first", folder / "u");
    if (fs::exists(folder / ("u/" + name)))
      fs::rename(folder / ("u/" + name), folder / outside);
    else
      std::ofstream(folder / outside) << "of somebody else";
    const std::string before = text_of(folder / outside);
    fs::create_symlink(folder / outside, folder / ("u/" + name));
    const Outcome outcome = sprekk_command(tutorial({"-q", "-o", "u", "--restart"}), folder.path());
    const bool is_partial = name.ends_with(".partial");  // left by a run that was killed, and made anew
    EXPECT_EQ(outcome.code, is_partial ? 0 : 2) << name << ": " << outcome.err;
    if (!is_partial) {
      EXPECT_THAT(outcome.err, HasSubstr("cannot continue u/" + name + " (it is a symbolic link"));
    }
    EXPECT_EQ(text_of(folder / outside), before) << name;
    fs::remove_all(folder / "u");
  }
}

TEST(RunFolder, ARemovedTableIsToldAndBeginsAnew) {
  const Folder folder;
  const std::vector<std::string> more = {"--set", "time.step=20 min", "--set",
                                         "output={checkpoint_every: 1 ms, fields: false}"};
  std::vector<std::string> arguments = {"-q", "-o", "u"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  Program program(tutorial(arguments), folder.path());
  wait_until(program, [&] { return rows(folder / "u/history.csv") > 5; });
  fs::remove(folder / "u/history.csv");
  wait_until(program, [&] { return rows(folder / "u/history.csv") > 5; });
  ASSERT_TRUE(program.is_running());
  program.signal(SIGKILL);
  EXPECT_EQ(program.wait().code, -SIGKILL);
  arguments.emplace_back("--restart");
  const Outcome rest = sprekk_command(tutorial(arguments), folder.path());
  EXPECT_EQ(rest.code, 0) << rest.err;
  EXPECT_THAT(rest.err, HasSubstr("history.csv was removed while the run wrote it"));
  EXPECT_LT(rows(folder / "u/history.csv"), 144);
  EXPECT_THAT(text_of(folder / "u/history.csv"), ::testing::StartsWith("time[s],"));
}

TEST(RunFolder, ThatCannotBeIsRefusedAtOnce) {
  const Folder folder;
  const auto refuses = [&](const Outcome& outcome, const std::string& why) {
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("cannot be made (" + why), HasSubstr("choose another one with -o")));
  };
  const std::string limit = "exec timeout -s KILL 20 ";
  refuses(shell_command(limit + tutorial_line("-q --set name=" + std::string(300, 'a')), folder.path()),
          "File name too long");
  refuses(shell_command(limit + tutorial_line("-q -o " + std::string(300, 'a')), folder.path()), "File name too long");
  fs::create_symlink("results", folder / "results");
  refuses(shell_command(limit + tutorial_line("-q"), folder.path()), "Too many levels of symbolic links");
  refuses(shell_command(limit + tutorial_line("-q -o results/a"), folder.path()), "Too many levels of symbolic links");
  fs::remove(folder / "results");
  std::ofstream(folder / "results") << "a file";
  refuses(shell_command(limit + tutorial_line("-q"), folder.path()), "Not a directory");
}

/// From the first step's Newton iterations on, before a row of history.csv: several seconds of work are left then.
void expect_checkpoint_within_a_step(int signal) {
  const Folder folder;
  const std::string sizes = "0.12 m, 0.06 m";
  const std::vector<std::string> time = {"--set", "time={end: 4 h, step: 4 h}"};
  std::vector<std::string> arguments = {"-q", "-o", "u"};
  arguments.insert(arguments.end(), time.begin(), time.end());
  Program program(tutorial(arguments, sizes), folder.path());
  wait_until(program, [&] { return rows(folder / "u/coupling.csv") >= 1; });
  ASSERT_TRUE(program.is_running());
  program.signal(signal);
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_EQ(rows(folder / "u/history.csv"), 0) << "within the first step";
  EXPECT_THAT(outcome.err, HasSubstr("interrupted"));
  ASSERT_TRUE(fs::exists(folder / "u/checkpoint.h5"));
  EXPECT_EQ(nlohmann::json::parse(text_of(folder / "u/run.json")).at("exit").at("reason"), "interrupted");
  if (signal != SIGTERM) return;
  arguments.emplace_back("--restart");
  const Outcome rest = sprekk_command(tutorial(arguments, sizes), folder.path());
  ASSERT_EQ(rest.code, 0) << rest.err;
  arguments = {"-q", "-o", "whole"};
  arguments.insert(arguments.end(), time.begin(), time.end());
  ASSERT_EQ(sprekk_command(tutorial(arguments, sizes), folder.path()).code, 0);
  for (const std::string table : {"/history.csv", "/coupling.csv"})
    EXPECT_EQ(text_of(folder / ("u" + table)), text_of(folder / ("whole" + table)));
}

TEST(Signals, EndARunWithinAStepWithACheckpoint) { expect_checkpoint_within_a_step(SIGTERM); }
TEST(Signals, TheEndOfATerminalLeavesACheckpoint) { expect_checkpoint_within_a_step(SIGHUP); }

TEST(Signals, AReaderThatGoesAwayLeavesACheckpoint) {
  const Folder folder;
  // The pipe's reader ends after the first line of progress, while 576 steps are to come.
  const Outcome outcome = shell_command(
      "{ " + tutorial_line("-o u --set 'time.step=5 min' 2>&1") + "; echo $? >code; } | head -c 1 >/dev/null",
      folder.path());
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(text_of(folder / "code"), "130\n");
  EXPECT_TRUE(fs::exists(folder / "u/checkpoint.h5"));
  EXPECT_LT(rows(folder / "u/history.csv"), 576);
  const Outcome rest = shell_command(tutorial_line("-q -o u --restart --set 'time.step=5 min'"), folder.path());
  EXPECT_EQ(rest.code, 0) << rest.err;
  EXPECT_EQ(rows(folder / "u/history.csv"), 576);
}

TEST(Signals, ASecondOneEndsTheProgramAtOnce) {
  const Folder folder;
  Program program(tutorial({"-q", "-o", "u", "--set", "time={end: 4 h, step: 4 h}"}, "0.12 m, 0.06 m"), folder.path());
  wait_until(program, [&] { return rows(folder / "u/coupling.csv") >= 1; });
  program.signal(SIGTERM);
  program.signal(SIGINT);
  const Clock::time_point begin = Clock::now();
  EXPECT_LT(program.wait().code, 0) << "by the signal";
  EXPECT_LT(seconds_since(begin), 2);
}

TEST(MemoryLimit, EndsWithAMessage) {
  // Less and less memory, down to where the program cannot be loaded (127). Whatever lacks it, the run ends by itself.
  int refused = 0;
  for (int megabytes = 700; megabytes >= 340; megabytes -= 60) {
    const Folder folder;
    const Outcome outcome =
        shell_command("ulimit -v " + std::to_string(1000 * megabytes) + "; exec timeout -s KILL 60 " +
                          tutorial_line("-q -o u --set 'time.end=4 h'"),
                      folder.path());
    EXPECT_THAT(outcome.code, ::testing::AnyOf(0, 1, 127)) << megabytes << " MB: " << outcome.err;
    if (outcome.code == 1) {
      EXPECT_THAT(outcome.err, HasSubstr("memory"));
    }
    refused += outcome.code == 1 ? 1 : 0;
  }
  EXPECT_GE(refused, 1);
}

TEST(Restart, WithStepsThatWereCutWritesTheTablesOfAWholeRun) {
  // Few iterations are allowed, so that attempts fail whose end is later than the checkpoint's time.
  const Folder folder;
  const auto arguments = [](std::vector<std::string> more) {
    for (const std::string setting :
         {"newton={at_most: 2, residual: 0.2, update: 0.2, pieces: 0}", "time={end: 8 h, step: 4 h}"})
      more.insert(more.end(), {"--set", setting});
    return tutorial(more);
  };
  ASSERT_EQ(sprekk_command(arguments({"-q", "-o", "whole"}), folder.path()).code, 0);
  ASSERT_GT(nlohmann::json::parse(text_of(folder / "whole/run.json")).at("counters").at("steps rejected"), 0);
  Program program(arguments({"-q", "-o", "u"}), folder.path());
  wait_until(program, [&] { return rows(folder / "u/history.csv") >= 1; });
  program.interrupt();
  ASSERT_EQ(program.wait().code, 130);
  ASSERT_EQ(sprekk_command(arguments({"-q", "-o", "u", "--restart"}), folder.path()).code, 0);
  for (const std::string table : {"/history.csv", "/coupling.csv"})
    EXPECT_EQ(text_of(folder / ("u" + table)), text_of(folder / ("whole" + table)));
}

/// The answer of a run that goes on is that of a whole one only if the tables that its scene names are the same.
TEST(Restart, RefusesATableThatHasChanged) {
  const Folder folder;
  const auto write = [&](const char* last) {
    std::ofstream(folder / "rates.csv") << "t[h],q[m^2/s]\n0,1e-7\n48," << last << "\n";
  };
  std::filesystem::copy_file(config("tutorial/first_scene.yaml"), folder / "scene.yaml");
  const auto run = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"run",
                                          "scene.yaml",
                                          "-q",
                                          "-o",
                                          "u",
                                          "--set",
                                          "mesh={size: 2 m}",
                                          "--set",
                                          "components.conduit.injection.well.rate={table: rates.csv}"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return sprekk_command(arguments, folder.path());
  };
  write("1e-7");
  ASSERT_EQ(run({"--set", "time.end=1 day"}).code, 0);
  const std::string before = text_of(folder / "u/history.csv");
  write("2e-7");
  const Outcome changed = run({"--restart"});
  EXPECT_EQ(changed.code, 2);
  EXPECT_THAT(changed.err,
              HasSubstr("has changed since it was written: no parameter has, but the content of rates.csv"));
  EXPECT_EQ(text_of(folder / "u/history.csv"), before);
  write("1e-7");
  const Outcome same = run({"--restart"});
  EXPECT_EQ(same.code, 0) << same.err;
}

TEST(Restart, RefusesTablesThatAreNotThoseOfTheRun) {
  const Folder folder;
  ASSERT_EQ(sprekk_command(tutorial({"-q", "-o", "u", "--set", "time.end=1 day"}), folder.path()).code, 0);
  const std::string history = text_of(folder / "u/history.csv");
  const auto expect_refusal = [&](const std::string& why) {
    const Outcome outcome = sprekk_command(tutorial({"-q", "-o", "u", "--restart"}), folder.path());
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("cannot continue u/history.csv (" + why), HasSubstr("put ")));
  };
  fs::remove(folder / "u/history.csv");
  expect_refusal("it is missing or cannot be read, and the run has written 6 rows");
  std::ofstream(folder / "u/history.csv") << history.substr(0, history.find('\n') + 1);
  expect_refusal("it has 0 rows, and the run has written 6");
  std::ofstream(folder / "u/history.csv") << "";
  expect_refusal("it has 0 rows, and the run has written 6");
  std::ofstream(folder / "u/history.csv") << history;
  EXPECT_EQ(sprekk_command(tutorial({"-q", "-o", "u", "--restart"}), folder.path()).code, 0);
  EXPECT_EQ(rows(folder / "u/history.csv"), 12);
}

TEST(Sweep, MayNotLeaveTheFolderOfResults) {
  const Folder folder;
  fs::create_directory(folder / "inside");
  for (const std::string name : {"../../outside", "..", ".", "a/b", "/tmp/outside", ".hidden", "''"}) {
    std::ofstream(folder / "inside/study.yaml")
        << "name: " << name << "\nscene: " << flow << "\ngrid: {time.step: [1 h, 30 min]}\n";
    const Outcome outcome = sprekk_command({"sweep", "study.yaml"}, folder / "inside");
    EXPECT_EQ(outcome.code, 2) << name;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("study.yaml:1:7: a study cannot be called"), HasSubstr("results/")));
    EXPECT_FALSE(fs::exists(folder / "outside"));
    EXPECT_FALSE(fs::exists(folder / "inside/results"));
  }
}

TEST(MeshFile, RunsNoCommands) {
  const Folder folder;
  std::ofstream(folder / "mesh.msh") << "SystemCall \"touch made\";\n";
  std::ofstream(folder / "scene.yaml") << "geometry: {file: mesh.msh}\n"
                                          "components: {pore: {type: matrix_flow/tpfa, permeability: 1 mD}}\n"
                                          "schedule: [{solve: [pore]}]\ntime: {end: 1 h, step: 1 h}\n";
  for (const std::string command : {"check", "show", "run", "graph"}) {
    const Outcome outcome = sprekk_command({command, "scene.yaml"}, folder.path());
    if (command != "show") {
      EXPECT_EQ(outcome.code, 2);
      EXPECT_THAT(outcome.err, HasSubstr("scene.yaml:1:18: cannot use the mesh file 'mesh.msh' (line 1: "));
    }
    EXPECT_FALSE(fs::exists(folder / "made")) << command;
  }
}

TEST(MeshFile, OfALargeBoxAroundASmallFractureIsMade) {
  const Folder folder;
  const Outcome outcome = sprekk_command({"check", config("verification/frictional_crack.yaml"), "--set",
                                          "mesh.fracture_size=0.01 m", "--set", "mesh.growth=0.3"},
                                         folder.path());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

}  // namespace
}  // namespace sprekk::testing
