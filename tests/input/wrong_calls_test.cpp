// Files that are no scenes, settings and arguments that are wrong, folders that cannot be used.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "tests/input/program.hpp"

namespace sprekk::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const std::string flow = std::string(SPREKK_SOURCE_DIR) + "/tests/input/base/flow.yaml";

/// The program refuses with all of these texts, and leaves the folder as it was.
void expect_refused(const std::vector<std::string>& arguments, const std::vector<std::string>& texts,
                    const Folder& folder) {
  const auto count = [&] { return std::distance(fs::recursive_directory_iterator(folder.path()), {}); };
  const auto before = count();
  const Outcome outcome = sprekk_command(arguments, folder.path());
  std::string call = "sprekk";
  for (const std::string& argument : arguments) call += " " + argument;
  SCOPED_TRACE(call);
  EXPECT_EQ(outcome.code, 2);
  for (const std::string& text : texts) EXPECT_THAT(outcome.err, HasSubstr(text));
  EXPECT_LE(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 25);
  EXPECT_EQ(count(), before) << "something was written";
}

TEST(SceneFiles, ThatAreNoScenesAreRefused) {
  const Folder folder;
  std::ofstream(folder / "empty.yaml").flush();
  std::ofstream(folder / "binary.yaml", std::ios::binary).write("name: \0\x01\x02\xff", 10);
  std::ofstream(folder / "latin.yaml", std::ios::binary) << "name: gr\xfcn\n";
  std::ofstream(folder / "missing_half.yaml") << "time: {end: 1 h, ste";
  fs::create_directory(folder / "folder.yaml");
  expect_refused({"check", "nowhere.yaml"}, {"nowhere.yaml: cannot be read (No such file or directory)"}, folder);
  expect_refused({"check", "folder.yaml"}, {"folder.yaml: cannot be read (it is a folder) give a file"}, folder);
  expect_refused({"check", "empty.yaml"}, {"empty.yaml: the scene is empty"}, folder);
  expect_refused({"check", "binary.yaml"}, {"binary.yaml:1: not a text file"}, folder);
  expect_refused({"check", "latin.yaml"}, {"latin.yaml:1: not a text file", "not UTF-8"}, folder);
  expect_refused({"check", "missing_half.yaml"}, {"missing_half.yaml:1:7: the '{' is never closed"}, folder);
  expect_refused({"run", "nowhere.yaml", "-o", "results"}, {"cannot be read"}, folder);
}

TEST(Settings, ThatAreWrongAreRefused) {
  const Folder folder;
  const auto refused = [&](const std::string& setting, const std::vector<std::string>& texts) {
    expect_refused({"check", flow, "--set", setting}, texts, folder);
    expect_refused({"run", flow, "--set", setting, "-o", "results"}, texts, folder);
  };
  refused("time.end", {"--set: 'time.end' sets nothing", "write for example"});
  refused("=3", {"'=3' sets nothing"});
  refused("time..end=3", {"--set time..end: empty name in the path"});
  refused("time.end.x=3", {"--set time.end.x: 'time.end' has no keys"});
  refused("time.ende=3", {"--set time.ende: unknown key 'ende' in 'time'", "did you mean 'end'?"});
  refused("tmie.end=3", {"unknown section of a scene 'tmie'", "did you mean 'time'?"});
  refused("components.pore.viscosity=1 m",
          {"--set components.pore.viscosity: '1 m' for 'viscosity' has the dimension of length"});
  refused("schedule.3.solve=pore", {"--set schedule.3.solve: 'schedule' has no item '3'"});
  refused("time.end=[1", {"--set time.end:1:1: the '[' is never closed"});
  refused("output.nothing=", {"there is no 'output.nothing' to remove"});
}

TEST(Arguments, ThatAreWrongAreRefused) {
  const Folder folder;
  expect_refused({}, {"a command is missing", "run, check", "--help"}, folder);
  expect_refused({"chekc", flow}, {"unknown command 'chekc'", "did you mean 'check'?"}, folder);
  expect_refused({"check"}, {"scene"}, folder);
  expect_refused({"check", flow, "--setting", "a=b"}, {"--setting"}, folder);
  expect_refused({"check", flow, "--set", "time.end=1 s", "time.step=1 s"},
                 {"no scene file 'time.step=1 s'", "write --set before each setting"}, folder);
  expect_refused({"explain", "matrix_flow/mfpa"},
                 {"unknown name 'matrix_flow/mfpa'", "did you mean 'matrix_flow/mpfa'?"}, folder);
  expect_refused({"graph", flow, "-o", "picture.png"}, {"has no known kind", "end it with .dot or .svg"}, folder);
  expect_refused({"graph", flow, "-o", "nowhere/picture.dot"}, {"cannot be written"}, folder);
  expect_refused({"graph", flow, "-o", "nowhere/picture.svg"}, {"cannot be written"}, folder);
}

TEST(OutputFolders, ThatCannotBeUsedAreRefused) {
  const Folder folder;
  fs::create_directory(folder / "full");
  std::ofstream(folder / "full/history.csv") << "somebody's results\n";
  expect_refused({"run", flow, "-o", "full"}, {"the output folder full is not empty", "choose another one with -o"},
                 folder);
  expect_refused({"run", flow, "-o", "full/history.csv"}, {"is a file", "choose another name"}, folder);
  expect_refused({"run", flow, "-o", "full/history.csv/results"}, {"cannot be made", "choose another one with -o"},
                 folder);
  EXPECT_EQ(text_of(folder / "full/history.csv"), "somebody's results\n");
}

TEST(Checkpoints, ThatCannotBeContinuedAreRefused) {
  const Folder folder;
  ASSERT_EQ(sprekk_command({"run", flow, "-q", "-o", "done"}, folder.path()).code, 0);
  const std::string checkpoint = text_of(folder / "done/checkpoint.h5");
  fs::create_directory(folder / "cut");
  std::ofstream(folder / "cut/checkpoint.h5", std::ios::binary) << checkpoint.substr(0, checkpoint.size() / 2);
  fs::create_directory(folder / "text");
  std::ofstream(folder / "text/checkpoint.h5") << "not a checkpoint\n";
  const std::string before = text_of(folder / "done/history.csv");

  expect_refused({"run", flow, "-o", "nowhere", "--restart"}, {"there is no such file"}, folder);
  // Wherever the option stands, a scene is no checkpoint.
  expect_refused({"run", "--restart", flow, "-o", "nowhere"}, {"there is no such file"}, folder);
  expect_refused({"run", "-o", "nowhere", "--restart", flow, "--set", "time.step=1 s"}, {"there is no such file"},
                 folder);
  expect_refused({"run", flow, "--restart", "cut/checkpoint.h5"}, {"cut/checkpoint.h5", "cut short"}, folder);
  expect_refused({"run", flow, "--restart", "text/checkpoint.h5"}, {"text/checkpoint.h5", "not an HDF5 file"}, folder);
  expect_refused({"run", flow, "--restart", "done"}, {"cannot restart from done"}, folder);
  expect_refused({"run", flow, "--set", "components.pore.viscosity=2 mPa*s", "-o", "done", "--restart"},
                 {"done/checkpoint.h5", "the scene 'flow' has changed since it was written",
                  "components.pore.viscosity was", "and is 2 mPa*s"},
                 folder);
  expect_refused({"run", flow, "--restart", "done/checkpoint.h5", "-o", "other"},
                 {"a run goes on in the folder of its checkpoint", "leave -o out"}, folder);
  expect_refused(
      {"run", flow, "--set", "output.probes.more={of: pore.pressure, take: mean}", "-o", "done", "--restart"},
      {"no column more[Pa]", "restart with the probes it had"}, folder);
  expect_refused({"run", flow, "--set", "mesh.cells=[5, 5]", "-o", "done", "--restart"}, {"done/checkpoint.h5"},
                 folder);
  EXPECT_EQ(text_of(folder / "done/history.csv"), before);
}

}  // namespace
}  // namespace sprekk::testing
