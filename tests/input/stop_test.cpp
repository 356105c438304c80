// `time.stop` ends a run, or a note says that it has not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/input/notes.hpp"

namespace sprekk::testing {
namespace {

using ::testing::HasSubstr;

TEST(Stop, IsTheReasonOfTheEnd) {
  const Folder folder;
  std::vector<std::string> arguments =
      call("run", "fractured.yaml", {"time.stop={of: fluid_injected, reaches: 1e-6 m^2}"});
  arguments.insert(arguments.end(), {"-o", "out"});
  const Outcome outcome = sprekk_command(arguments, folder.path());
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json record = Json::parse(text_of(folder / "out/run.json"));
  EXPECT_EQ(record["exit"]["reason"], "stopped: fluid_injected has reached 1e-6 m^2");
  EXPECT_EQ(record["counters"]["steps accepted"], 2);  // 0.6e-6 m^2 each
  EXPECT_THAT(outcome.err, HasSubstr("ended after step 2 at t = 20 min 0 s: fluid_injected has reached 1e-6 m^2"));
}

TEST(Stop, ThatIsNotReachedIsTold) {
  const Ended run = run_of("fractured.yaml", {"time.stop={of: fluid_injected, reaches: 1 m^2}"});
  EXPECT_EQ(run.record["exit"]["reason"], "done");
  EXPECT_THAT(run.note("time.stop")["text"].get<std::string>(), HasSubstr("has not reached 1 m^2"));
}

}  // namespace
}  // namespace sprekk::testing
