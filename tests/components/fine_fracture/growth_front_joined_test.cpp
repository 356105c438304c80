// A tip that no trial has examined, and that grows in the state of the front which was found without it.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "tests/components/fine_fracture/closed_form_front.hpp"

namespace sprekk::fine_fracture {
namespace {

/// A new segment that is to begin with these values once it grows.
struct FirstTrial {
  double length, angle;  ///< m, rad
};

/// One tip goes on, and the other one (`late`) has no segment. Without it the first tip advances by rise/50 m.
struct LateTip {
  ClosedForm form;
  int late;
  FrontOptions front_options;

  LateTip(double rise, double rise_of_late, int late, const FrontOptions& options)
      : form{{rise, rise_of_late}, {tip(0.4), tip(-2.0)}}, late(late), front_options(options) {
    if (late == 0) std::swap(form.rise[0], form.rise[1]);
    FrontTip& start = form.tips[late];
    start.covered = 0;
    start.longest = 0.015;
  }

  std::vector<FrontState> states(const Front& front, bool with_late) const {
    std::vector<double> lengths, angles;
    for (int i = 0; i < 2; ++i) {
      // The load of a tip without a segment is that of its old end.
      lengths.push_back(front.is_laid(i) ? front.length(i) : form.tips[i].covered);
      angles.push_back(front.is_laid(i) ? front.angle(i) : form.tips[i].angle);
    }
    std::vector<FrontState> states = form.states(lengths, angles);
    if (!with_late && !front.is_laid(late)) states[late] = {{}, 0, false};
    return states;
  }

  Front found_without_late() const {
    std::vector<FrontState> start = form.without_growth();
    start[late] = {{}, 0, false};
    Front front(form.tips, start, front_options, 3600);
    search(front);
    return front;
  }
  void search(Front& front) const {
    while (front.verdict() == Front::Verdict::again) front.learn(states(front, false));
  }
};

/// K = K_IC and K_II = 0 at both tips, whose advances follow from the closed form, whatever the segment that the second
/// tip begins with.
TEST(Front, ATipThatGrewAfterTheFrontWasFoundIsSearchedForToo) {
  const double sum = (0.3 + 0.25) / (20 + 2 * 30.0);
  for (const int late : {0, 1})
    for (const double perturbed : {1.0, 1 + 1e-9})
      for (const auto& first : {std::optional<FirstTrial>({0.002, -0.1}), std::optional<FirstTrial>({0.0035, 0.03}),
                                std::optional<FirstTrial>()}) {
        const LateTip scene(0.3 * perturbed, 0.25 * perturbed, late, exact());
        Front front = scene.found_without_late();
        ASSERT_EQ(front.verdict(), Front::Verdict::found);
        EXPECT_NEAR(front.length(1 - late), 0.008 + 0.3 / 50, 1e-8);
        const int before = front.trials();
        const FrontTip& tip = scene.form.tips[late];
        if (first) front.begin_with(late, first->length, tip.angle + first->angle);
        front.learn_of_others(scene.states(front, true));
        ASSERT_EQ(front.verdict(), Front::Verdict::again);
        ASSERT_TRUE(front.is_laid(late));
        if (first) {
          EXPECT_EQ(front.length(late), first->length);
          EXPECT_EQ(front.angle(late), tip.angle + first->angle);
        }
        scene.search(front);
        ASSERT_EQ(front.verdict(), Front::Verdict::found) << front.reason();
        EXPECT_FALSE(front.is_rough());
        EXPECT_NEAR(front.length(1 - late) - 0.008, (0.3 - 30 * sum) / 20, 2e-8);
        EXPECT_NEAR(front.length(late), (0.25 - 30 * sum) / 20, 2e-8);
        EXPECT_NEAR(front.angle(late), tip.angle + scene.form.turn * front.length(late), 2e-6);
        EXPECT_LE(front.trials() - before, 10);
      }
}

/// Nothing changes where the advance of the others has unloaded it.
TEST(Front, ATipThatIsBelowItsToughnessInTheFrontThatWasFoundRests) {
  for (const int late : {0, 1}) {
    const LateTip scene(0.3, 0.17, late,
                        exact());  // above its toughness without growth, at exp(-0.01) of it in the end
    Front front = scene.found_without_late();
    ASSERT_EQ(front.verdict(), Front::Verdict::found);
    const int trials = front.trials();
    front.learn_of_others(scene.states(front, true));
    EXPECT_EQ(front.verdict(), Front::Verdict::found);
    EXPECT_FALSE(front.grows(late));
    EXPECT_EQ(front.trials(), trials);
    EXPECT_NEAR(front.length(1 - late), 0.008 + 0.3 / 50, 1e-8);
  }
}

/// A tip that was examined in the trials is not asked a second time.
TEST(Front, AFrontThatWasFoundStaysWhereAllTipsWereExamined) {
  const ClosedForm form{{0.3, 0.17}, {tip(0.4), tip(-2.0)}};  // the second tip rests
  Front front = form.solved(exact());
  ASSERT_EQ(front.verdict(), Front::Verdict::found);
  ASSERT_TRUE(front.grows(0));
  ASSERT_FALSE(front.grows(1));
  const double length = front.length(0);
  std::vector<FrontState> states = form.states({front.length(0), front.length(1)}, {front.angle(0), front.angle(1)});
  states[1].load = 1.01;
  front.learn_of_others(states);
  EXPECT_EQ(front.verdict(), Front::Verdict::found);
  EXPECT_FALSE(front.grows(1));
  EXPECT_EQ(front.length(0), length);
}

}  // namespace
}  // namespace sprekk::fine_fracture
