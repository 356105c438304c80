// Every scene in broken/ has a mistake. Its comments say what the answer contains, and which scene of base/ it changes:
//   # expect: typo_key.yaml:5:10: unknown key 'permeabilty'
//   # because: a misspelt parameter (grade: A)
//   # over: flow.yaml
// The grade is that of a reader who had not seen the code: A says what is wrong, where, why and what to do; B lacks one
// of them, or is clumsy; C lacks two, or misleads; '-': the message has changed since.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tests/input/program.hpp"

namespace sprekk::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const fs::path here = fs::path(SPREKK_SOURCE_DIR) / "tests/input";

struct BrokenScene {
  std::vector<std::string> files, expected;
  std::string because;
};

BrokenScene read_broken_scene(const std::string& name) {
  const fs::path file = here / "broken" / (name + ".yaml");
  BrokenScene scene;
  std::istringstream lines(text_of(file));
  for (std::string line; std::getline(lines, line);) {
    const auto value = [&](const std::string& key) {
      return line.rfind(key, 0) == 0 ? line.substr(key.size()) : std::string();
    };
    if (!value("# expect: ").empty()) scene.expected.push_back(value("# expect: "));
    if (!value("# because: ").empty()) scene.because = value("# because: ");
    if (!value("# over: ").empty()) scene.files.push_back((here / "base" / value("# over: ")).string());
  }
  scene.files.push_back(file.string());
  return scene;
}

std::vector<std::string> names() {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(here / "broken"))
    names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

class BrokenScenes : public ::testing::TestWithParam<std::string> {};

TEST_P(BrokenScenes, AreRefusedWithTheReasonAndNothingIsWritten) {
  const BrokenScene scene = read_broken_scene(GetParam());
  ASSERT_FALSE(scene.expected.empty());
  SCOPED_TRACE(scene.because);
  for (const std::string command : {"check", "run"}) {
    const Folder folder;
    std::vector<std::string> arguments = {command};
    arguments.insert(arguments.end(), scene.files.begin(), scene.files.end());
    if (command == "run") arguments.insert(arguments.end(), {"-o", "results"});
    const Outcome outcome = sprekk_command(arguments, folder.path());
    EXPECT_EQ(outcome.code, 2) << command;
    EXPECT_EQ(outcome.out, "") << command;
    for (const std::string& text : scene.expected) EXPECT_THAT(outcome.err, HasSubstr(text)) << command;
    EXPECT_LE(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 25) << command;
    EXPECT_TRUE(fs::is_empty(folder.path())) << command << " has written something";
  }
}

INSTANTIATE_TEST_SUITE_P(Input, BrokenScenes, ::testing::ValuesIn(names()),
                         [](const auto& info) { return info.param; });

TEST(BaseScenes, AreRight) {
  const Folder folder;
  for (const std::string name : {"flow", "rock", "fractured"}) {
    const Outcome outcome = sprekk_command({"check", (here / "base" / (name + ".yaml")).string()}, folder.path());
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  }
}

}  // namespace
}  // namespace sprekk::testing
