#include "framework/output/progress.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <cstdlib>
#include <sstream>

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

TEST_F(ProgressTest, SilentIsSilent) {
  Progress progress = make(Style::silent);
  progress.reached(50, 1);
  progress.event("fracture grew");
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
