#include "framework/output/progress.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <sstream>
#include <thread>

namespace sprekk {
namespace {

using testing::HasSubstr;
using Style = Progress::Style;

class ProgressTest : public testing::Test {
 protected:
  Progress make(Style style) {
    return Progress(style, out, 0, 100, [this] { return now; });
  }
  int bars() const {
    int count = 0;
    for (const char c : out.str()) count += c == '[';
    for (std::size_t at = 0; (at = out.str().find("\x1b[K", at)) != std::string::npos; ++at) --count;
    return count;
  }
  double now = 1000;
  std::ostringstream out;
};

TEST_F(ProgressTest, TheBarShowsPercentAndTimeLeft) {
  Progress progress = make(Style::bar);
  now += 30;
  progress.reached(25, 5);
  EXPECT_EQ(out.str(), "[#######.......................]  25 %  step 5  t = 25 s  1 min 30 s left");
}

TEST_F(ProgressTest, TheBarIsDrawnAtMostTenTimesASecondAndAtTheEnd) {
  Progress progress = make(Style::bar);
  for (int step = 1; step <= 100; ++step) {
    now += 0.01;
    progress.reached(step, step);
  }
  // One second: ten drawings one interval apart, and the first and the last step.
  EXPECT_GE(bars(), 9);
  EXPECT_LE(bars(), 12);
  EXPECT_THAT(out.str(), testing::EndsWith("100 %  step 100  t = 1 min 40 s  0 s left"));
}

TEST_F(ProgressTest, AnEventTakesTheBarsPlace) {
  {
    Progress progress = make(Style::bar);
    progress.reached(50, 1);
    progress.event("step 2 was cut");
    EXPECT_THAT(out.str(), testing::EndsWith("\r\x1b[Kstep 2 was cut\n"));
    progress.reached(60, 2);
  }
  EXPECT_THAT(out.str(), testing::EndsWith(" left\n"));
}

TEST_F(ProgressTest, ElsewhereThereIsOneLineAnEvent) {
  Progress progress = make(Style::lines);
  now += 10;
  progress.reached(50, 1);
  progress.event("fracture grew");
  EXPECT_EQ(out.str(), " 50 %  step 1  t = 50 s  10 s left\nfracture grew\n");
}

TEST_F(ProgressTest, LongPartsAreToldWithTheirTime) {
  Progress progress = make(Style::lines);
  progress.phase("building the model");
  progress.part("the mesh");
  now += 9;
  progress.tick();
  EXPECT_EQ(out.str(), "");  // short activities get no line
  now += 2;
  progress.tick();
  progress.tick();
  EXPECT_EQ(out.str(), "… building the model: the mesh, 11 s\n");
  now += 1;
  progress.part("component rock");
  now += 1;
  progress.part("component pore");
  EXPECT_THAT(out.str(), testing::EndsWith("11 s\nbuilding the model: the mesh took 12 s\n"));
  EXPECT_THAT(out.str(), testing::Not(HasSubstr("rock")));
}

TEST_F(ProgressTest, NoMinuteOfAStepPassesWithoutAWord) {
  Progress progress = make(Style::lines);
  progress.reached(10, 1);
  progress.phase("step 2 from 10 s over 5 s");
  for (int iteration = 0; iteration < 300; ++iteration) {
    progress.part("solve rock, iteration " + std::to_string(iteration), true);
    now += 1;
    progress.tick();
  }
  // After 10 s, and then once a minute.
  const std::string text = out.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + 1 + 4);
  EXPECT_THAT(text, HasSubstr("… step 2 from 10 s over 5 s: solve rock, iteration 69, 1 min 10 s\n"));
  EXPECT_THAT(text, testing::Not(HasSubstr("took")));
}

TEST_F(ProgressTest, TheBarTellsWhatGoesOnWhileAStepDoes) {
  Progress progress = make(Style::bar);
  progress.reached(25, 5);
  progress.phase("step 6 from 25 s over 5 s");
  progress.part("solve rock, iteration 3, residual 1.0e-03", true);
  progress.tick();
  EXPECT_THAT(out.str(), testing::Not(HasSubstr("iteration")));  // not before it takes long
  now += 7;
  progress.tick();
  EXPECT_THAT(out.str(),
              testing::EndsWith("step 6 from 25 s over 5 s: solve rock, iteration 3, residual 1.0e-03, 7 s"));
  now += 1;
  progress.reached(30, 6);
  EXPECT_THAT(out.str(), testing::EndsWith(" left"));
}

TEST_F(ProgressTest, ARunThatIsStoppedSaysSo) {
  Progress progress = make(Style::bar);
  progress.reached(28, 7);
  progress.stopped(28, 7, "injected has reached 3 m^2");
  EXPECT_THAT(out.str(), testing::EndsWith("\r\x1b[Kended after step 7 at t = 28 s: injected has reached 3 m^2\n"));
}

TEST(ProgressWatch, SpeaksWhileNobodyCalls) {
  std::ostringstream out;
  std::atomic<double> now = 0;
  Progress progress(Style::lines, out, 0, 1, [&] { return now.load(); });
  progress.phase("building");
  progress.watch();
  now = 100;
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  progress.close();
  EXPECT_EQ(out.str(), "… building, 1 min 40 s\n");
}

TEST_F(ProgressTest, SilentIsSilent) {
  Progress progress = make(Style::silent);
  progress.watch();
  progress.reached(50, 1);
  progress.event("fracture grew");
  progress.phase("step");
  now += 1000;
  progress.tick();
  progress.stopped(50, 1, "steady");
  EXPECT_EQ(out.str(), "");
}

TEST_F(ProgressTest, ARunWithoutTimeIsDoneWhenItsStepIs) {
  Progress progress(Style::lines, out, 0, 0, [] { return 0.0; });
  progress.reached(0, 1);
  EXPECT_THAT(out.str(), HasSubstr("100 %"));
}

TEST_F(ProgressTest, TheStyleFollowsTheTerminalTheRankAndQuiet) {
  const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_GE(terminal, 0);
  const int file = ::open("/dev/null", O_WRONLY);
  EXPECT_EQ(Progress::style_for(terminal, true, false), Style::bar);
  EXPECT_EQ(Progress::style_for(terminal, true, true), Style::silent);
  EXPECT_EQ(Progress::style_for(terminal, false, false), Style::silent);
  EXPECT_EQ(Progress::style_for(file, true, false), Style::lines);
  ::close(terminal);
  ::close(file);
}

TEST(DurationText, IsReadable) {
  EXPECT_EQ(duration_text(0), "0 s");
  EXPECT_EQ(duration_text(0.0123), "0.0123 s");
  EXPECT_EQ(duration_text(59), "59 s");
  EXPECT_EQ(duration_text(59.999), "1 min 0 s");
  EXPECT_EQ(duration_text(60), "1 min 0 s");
  EXPECT_EQ(duration_text(3599.9), "1 h 0 min");
  EXPECT_EQ(duration_text(7500), "2 h 5 min");
  EXPECT_EQ(duration_text(86400 * 4 + 3600 * 3), "4 d 3 h");
  EXPECT_EQ(duration_text(3e22), "9.51e+14 years");  // steady states: more minutes than an integer holds
  EXPECT_EQ(duration_text(1e300 * 1e300), "?");
}

}  // namespace
}  // namespace sprekk
