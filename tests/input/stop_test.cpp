// `time.stop` ends a run, or a note says that it has not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/input/notes.hpp"

namespace sprekk::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

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

TEST(Stop, ComesFromAboveToo) {
  // The left side at 0 Pa drains the loaded rock: the pressure is far above 0 after the first step, and falls.
  const Settings drained = {"output.probes={p: {of: pore.pressure, take: mean}}", "time.end=10 day", "time.step=1 h"};
  const auto stopped = [&](const std::string& stop) {
    Settings settings = drained;
    settings.push_back("time.stop=" + stop);
    return run_of("fractured.yaml", settings);
  };
  const Ended whole = run_of("fractured.yaml", drained);
  const double end = whole.result("p[Pa]");
  const Ended fallen = stopped("{of: p, falls_to: " + std::to_string(1.1 * end) + " Pa}");
  EXPECT_THAT(fallen.record["exit"]["reason"].get<std::string>(), HasSubstr("stopped: p has fallen to "));
  EXPECT_GT(fallen.record["counters"]["steps accepted"], 1);
  EXPECT_LT(fallen.record["counters"]["steps accepted"], whole.record["counters"]["steps accepted"]);
  EXPECT_LE(fallen.result("p[Pa]"), 1.1 * end);
  EXPECT_GT(fallen.result("p[Pa]"), end);
  const Ended missed = stopped("{of: p, falls_to: " + std::to_string(0.5 * end) + " Pa}");
  EXPECT_THAT(missed.note("time.stop")["text"].get<std::string>(), HasSubstr("has not fallen to"));
}

TEST(Stop, ThatTheStartHasReachedIsTold) {
  const Settings probe = {"output.probes={p: {of: pore.pressure, take: mean}}",
                          "components.pore.initial_pressure=9 MPa", "components.conduit.initial_pressure=9 MPa"};
  Settings settings = probe;
  settings.push_back("time.stop={of: p, reaches: 1 MPa}");
  const Ended at_once = run_of("fractured.yaml", settings);
  EXPECT_EQ(at_once.record["counters"]["steps accepted"], 1);
  EXPECT_THAT(at_once.note("time.stop in the first step")["text"].get<std::string>(), HasSubstr("at the start"));
  settings.back() = "time.stop={of: p, reaches: 90 MPa}";
  EXPECT_TRUE(run_of("fractured.yaml", settings).note("time.stop in the first step").is_null());
}

TEST(Stop, ThatIsNotReachedIsTold) {
  const Ended run = run_of("fractured.yaml", {"time.stop={of: fluid_injected, reaches: 1 m^2}"});
  EXPECT_EQ(run.record["exit"]["reason"], "done");
  EXPECT_THAT(run.note("time.stop")["text"].get<std::string>(), HasSubstr("has not reached 1 m^2"));
}

TEST(Stop, MayHaveSeveralTerms) {
  // 0.6e-6 m^2 enter in each step.
  const auto run = [](const std::string& terms) { return run_of("fractured.yaml", {"time.stop=" + terms}); };
  const std::string first = "{of: fluid_injected, reaches: 1e-6 m^2}",
                    second = "{of: fluid_injected, reaches: 2e-6 m^2}",
                    never = "{of: fluid_injected, falls_to: -1 m^2}";
  const Ended any = run("{any: [" + never + ", " + second + ", " + first + "]}");
  EXPECT_EQ(any.record["counters"]["steps accepted"], 2);
  EXPECT_EQ(any.record["exit"]["reason"], "stopped: fluid_injected has reached 1e-6 m^2");
  const Ended all = run("{all: [" + first + ", " + second + "]}");
  EXPECT_EQ(all.record["counters"]["steps accepted"], 4);
  EXPECT_EQ(all.record["exit"]["reason"],
            "stopped: fluid_injected has reached 1e-6 m^2, and fluid_injected has reached 2e-6 m^2");
  const Ended missed = run("{all: [" + first + ", " + never + "]}");
  EXPECT_EQ(missed.record["exit"]["reason"], "done");
  const std::string told = missed.note("time.stop")["text"].get<std::string>();
  EXPECT_THAT(told, HasSubstr("has not fallen to -1 m^2"));
  EXPECT_THAT(told, Not(HasSubstr("has not reached 1e-6 m^2")));
}

}  // namespace
}  // namespace sprekk::testing
