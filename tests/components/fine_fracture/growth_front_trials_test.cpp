// How many trials the search for the advance of tips needs after a step like the one before.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/components/fine_fracture/closed_form_front.hpp"

namespace sprekk::fine_fracture {
namespace {

/// Tips at the speed of their last step, with the slopes from the search of that step.
TEST(Front, NeedsFewTrialsAfterASimilarStep) {
  const ClosedForm form{{0.3, 0.33}, {tip(0.4), tip(-2.0)}};
  const Front first = form.solved(exact());
  ClosedForm next = form;
  next.rise = {0.31, 0.325};
  for (int i = 0; i < 2; ++i) {
    FrontTip& tip = next.tips[i];
    tip.speed = 1.05 * (first.length(i) - tip.covered) / 3600;
    tip.turning = 0.8 * form.turn;
    tip.goes_on = true;
  }
  const Front front = next.solved(exact(), first.slopes());
  ASSERT_EQ(front.verdict(), Front::Verdict::found);
  const double sum = 0.635 / (form.own + 2 * form.shared);
  EXPECT_NEAR(front.length(0) - 0.008, (0.31 - form.shared * sum) / form.own, 2e-8);
  EXPECT_LE(front.trials(), 4);
}

/// One tip on a curved path in its whole frame: an angle moves the tip across by the length of its segment, which
/// changes K, and K_II follows the direction as at a kink. K_eq depends on the square of K_II.
struct CurvedPath {
  double rise, right_angle;  ///< of ln K at the start of the step; rad, of the path there
  FrontTip tip;

  FrontState state(double length, double angle) const {
    const double added = length - tip.covered, wrong = angle - right_angle - 8 * added;
    const double k = tip.toughness * std::exp(rise - 30 * added + 20 * length * wrong), t_stress = -2e7;
    const double direction = wrong * (0.5 - 2 * std::sqrt(2 / std::numbers::pi) * t_stress * std::sqrt(length) / 7e5);
    FrontState state{{k * std::cos(direction), k * std::sin(direction), t_stress}, 0};
    state.load = equivalent_sif(state.sifs) / tip.toughness;
    return state;
  }
  Front solved(const Eigen::MatrixXd& slopes = {}) const {
    Front front({tip}, {state(tip.covered, tip.angle)}, options(), 3600, slopes);
    while (front.verdict() == Front::Verdict::again) front.learn({state(front.length(0), front.angle(0))});
    return front;
  }
};

/// A segment that is divided has another direction than the path at its end, and is shorter than that of the last step.
TEST(Front, NeedsFewTrialsAfterASegmentWasDivided) {
  CurvedPath path{0.12, 0.4, tip(0.4)};
  const Front before = path.solved();
  ASSERT_EQ(before.verdict(), Front::Verdict::found);
  const double advance = before.length(0) - path.tip.covered;
  EXPECT_NEAR(advance, 0.12 / 30, 1e-8);
  path.right_angle = path.tip.ahead = before.angle(0);
  path.tip.angle = before.angle(0) + 0.05;
  path.tip.covered = 0.005;
  path.tip.speed = advance / 3600;
  path.tip.turning = (before.angle(0) - 0.4) / advance;
  path.tip.goes_on = true;
  path.rise = 0.11;
  const Front front = path.solved(before.slopes());
  ASSERT_EQ(front.verdict(), Front::Verdict::found);
  EXPECT_NEAR(front.length(0) - 0.005, 0.11 / 30, 1e-8);
  EXPECT_NEAR(front.angle(0), before.angle(0) + 8 * 0.11 / 30, 1e-5);
  EXPECT_LE(front.trials(), 4);
}

/// The search learns no slopes for the turns of a tip at rest: after some steps at rest it needs no more trials than
/// before.
TEST(Front, NeedsFewTrialsAfterStepsAtRest) {
  CurvedPath path{0.12, 0.4, tip(0.4)};
  const Front before = path.solved();
  ASSERT_EQ(before.verdict(), Front::Verdict::found);
  path.tip.speed = 0.004 / 3600;
  path.tip.goes_on = true;
  Eigen::MatrixXd slopes = before.slopes();
  path.rise = -0.01;
  for (int k = 0; k < 6; ++k) {
    const Front rest = path.solved(slopes);
    ASSERT_EQ(rest.verdict(), Front::Verdict::found);
    EXPECT_FALSE(rest.grows(0));
    slopes = rest.slopes();
  }
  path.rise = 0.11;
  const Front front = path.solved(slopes);
  ASSERT_EQ(front.verdict(), Front::Verdict::found);
  EXPECT_NEAR(front.length(0) - 0.008, 0.11 / 30, 1e-8);
  EXPECT_NEAR(front.angle(0), 0.4 + 8 * 0.11 / 30, 1e-5);
  EXPECT_LE(front.trials(), 6);
}

/// When the mesh of the trials is made anew, K is 1e-3 larger from then on, as it is between two meshes: a trial near
/// the front on the old mesh is no best one any more.
TEST(Front, ForgetsTrialsOnAnotherMesh) {
  for (const int change : {2, 3, 4}) {
    const ClosedForm form{{0.3, 0.33}, {tip(0.4), tip(-2.0)}};
    Front front(form.tips, form.without_growth(), exact(), 3600);
    while (front.verdict() == Front::Verdict::again) {
      const bool is_other = front.trials() >= change;
      if (front.trials() == change) front.change_mesh();
      ClosedForm on_mesh = form;
      if (is_other)
        for (double& rise : on_mesh.rise) rise += 1e-3;
      front.learn(on_mesh.states({front.length(0), front.length(1)}, {front.angle(0), front.angle(1)}));
    }
    ASSERT_EQ(front.verdict(), Front::Verdict::found) << change;
    ASSERT_GT(front.trials(), change);
    EXPECT_LE(front.trials(), change + 7) << change;
    const double sum = 0.632 / (form.own + 2 * form.shared);
    EXPECT_NEAR(front.length(0) - 0.008, (0.301 - form.shared * sum) / form.own, 2e-8) << change;
  }
}

/// K of a wing falls with its own length, as 1 / sqrt(length), whatever the length of the fracture that it belongs to.
/// The search begins with the new segment of the kink; the next one knows the slope from it, at twice the length.
TEST(Front, NeedsFewTrialsBehindAKink) {
  const auto solved = [](const FrontTip& tip, double rise, double from, const Eigen::MatrixXd& slopes) {
    const auto state = [&](double length, double angle) {
      const double k = tip.toughness * std::exp(rise) * std::sqrt(from / length), wrong = 0.5 * (angle - 1.2);
      FrontState state{{k * std::cos(wrong), k * std::sin(wrong), 0}, 0};
      state.load = equivalent_sif(state.sifs) / tip.toughness;
      return state;
    };
    Front front({tip}, {state(from, 1.2)}, options(), 3600, slopes);
    while (front.verdict() == Front::Verdict::again) front.learn({state(front.length(0), front.angle(0))});
    return front;
  };
  FrontTip wing = tip(0);
  wing.covered = 0;
  wing.size = 0.1;
  wing.first_length = 0.004;
  wing.first_angle = 1.2;
  const Front kink = solved(wing, 0.5 * std::log(1.2), 0.004, {});
  ASSERT_EQ(kink.verdict(), Front::Verdict::found);
  EXPECT_NEAR(kink.length(0), 0.0048, 1e-8);

  wing = tip(1.2);
  wing.covered = wing.size = kink.length(0);
  wing.speed = 0.0047 / 3600;
  wing.goes_on = true;
  const Front next = solved(wing, 0.5 * std::log(2.0), wing.covered, kink.slopes());
  ASSERT_EQ(next.verdict(), Front::Verdict::found);
  EXPECT_NEAR(next.length(0), 2 * wing.covered, 1e-7);
  EXPECT_LE(next.trials(), 4);
}

}  // namespace
}  // namespace sprekk::fine_fracture
