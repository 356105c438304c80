// When notes of runs and checks are shown, and where they stand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/input/notes.hpp"

namespace sprekk::testing {
namespace {

using ::testing::HasSubstr;

TEST(Notes, OfTheInputAreShownByARunAtItsStartAndAtItsEnd) {
  const Folder folder;
  std::vector<std::string> arguments = call("run", "flow.yaml", {"components.pore.porosity=0.1"});
  arguments.insert(arguments.end(), {"-o", "out"});
  const Outcome outcome = sprekk_command(arguments, folder.path());
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string text = "note: ";
  const std::size_t first = outcome.err.find(text), step = outcome.err.find(" %  step 1"),
                    last = outcome.err.rfind("'porosity' of 'pore' has no effect");
  EXPECT_LT(first, step);
  EXPECT_LT(step, last);
  const Json notes = Json::parse(text_of(folder / "out/run.json"))["notes"];
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0]["steps"], 0);
}

TEST(Notes, GoOnWithARestart) {
  const Folder folder;
  const Settings scene = {"components.pore.initial_pressure=1 MPa", "components.pore.storage=0 1/Pa",
                          "components.pore.boundary.left.flux=1e-4 m/s", "output.fields=false"};
  const auto run = [&](const std::string& out, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = call("run", "flow.yaml", scene);
    arguments.insert(arguments.end(), {"-q", "-o", out});
    arguments.insert(arguments.end(), more.begin(), more.end());
    ASSERT_EQ(sprekk_command(arguments, folder.path()).code, 0);
  };
  run("whole", {});
  run("parts", {"--set", "time.end=30 min"});
  run("parts", {"--restart"});
  const auto notes = [&](const std::string& out) {
    return Json::parse(text_of(folder / (out + "/run.json")))["notes"];
  };
  ASSERT_EQ(notes("whole").size(), 1U);
  EXPECT_EQ(notes("whole"), notes("parts"));
}

TEST(Notes, AreOnThePageOfARunBeforeItsFigures) {
  const Folder folder;
  std::vector<std::string> arguments = call("run", "rock.yaml", {"components.rock.boundary.top.normal_stress=-1 GPa"});
  arguments.insert(arguments.end(), {"-q", "-o", "out"});
  ASSERT_EQ(sprekk_command(arguments, folder.path()).code, 0);
  ASSERT_EQ(sprekk_command({"report", "out"}, folder.path()).code, 0);
  const std::string page = text_of(folder / "out/report.html");
  const std::size_t note = page.find("of the distance at");
  ASSERT_NE(note, std::string::npos);
  EXPECT_LT(note, page.find("mesh at the start"));
}

}  // namespace
}  // namespace sprekk::testing
