#include "tests/input/notes.hpp"

#include <gtest/gtest.h>

namespace sprekk::testing {

std::vector<std::string> call(const std::string& command, const std::string& scene, const Settings& settings) {
  std::vector<std::string> arguments = {command, std::string(SPREKK_SOURCE_DIR) + "/tests/input/base/" + scene};
  for (const std::string& setting : settings) arguments.insert(arguments.end(), {"--set", setting});
  return arguments;
}

std::string notes_of_check(const std::string& scene, const Settings& settings) {
  const Folder folder;
  const Outcome outcome = sprekk_command(call("check", scene, settings), folder.path());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  return outcome.err;
}

Json Ended::note(const std::string& topic) const {
  for (const Json& note : record["notes"])
    if (note["topic"].get<std::string>().find(topic) != std::string::npos) return note;
  return nullptr;
}

Ended run_of(const std::string& scene, const Settings& settings, const std::vector<std::string>& more) {
  const Folder folder;
  std::vector<std::string> arguments = call("run", scene, settings);
  arguments.insert(arguments.end(), {"-q", "-o", "out", "--set", "output.fields=false"});
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Outcome outcome = sprekk_command(arguments, folder.path());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  return {Json::parse(text_of(folder / "out/run.json")), outcome.err};
}

}  // namespace sprekk::testing
