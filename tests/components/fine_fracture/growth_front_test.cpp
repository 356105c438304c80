// The search for the advance of tips in one step, with factors in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/components/fine_fracture/closed_form_front.hpp"

namespace sprekk::fine_fracture {
namespace {

TEST(Front, FindsTheLengthAndTheDirectionOfOneTip) {
  const Front front = ClosedForm{{0.3}, {tip(0.4)}}.solved(options());
  ASSERT_EQ(front.verdict(), Front::Verdict::found);
  EXPECT_NEAR(front.length(0), 0.008 + 0.3 / 50, 1e-8);
  EXPECT_NEAR(front.angle(0), 0.4 + 8 * 0.3 / 50, 1e-4);
  EXPECT_LE(front.trials(), 8);
}

TEST(Front, FindsTipsThatShareTheirFluid) {
  const ClosedForm form{{0.3, 0.33}, {tip(0.4), tip(-2.0)}};
  const Front front = form.solved(exact());
  ASSERT_EQ(front.verdict(), Front::Verdict::found);
  const double sum = 0.63 / (form.own + 2 * form.shared);
  EXPECT_NEAR(front.length(0) - 0.008, (0.3 - form.shared * sum) / form.own, 2e-8);
  EXPECT_NEAR(front.length(1) - 0.008, (0.33 - form.shared * sum) / form.own, 2e-8);
}

/// Growth of either tip lowers K of both by the same: an error of the mesh in K must not decide which tip advances.
TEST(Front, TipsThatAreNotToldFromOneAnotherShareTheAdvance) {
  for (const double noise : {0.0, 1e-12, 1e-6, 1e-4, 1e-3}) {
    ClosedForm form{{0.3 + noise, 0.3 - 0.5 * noise}, {tip(0.4), tip(-2.0)}};
    form.own = 0;
    const Front front = form.solved(options());
    ASSERT_EQ(front.verdict(), Front::Verdict::found) << noise;
    EXPECT_NEAR(front.length(0), 0.008 + (0.3 + 0.25 * noise) / (2 * form.shared), 2e-8) << noise;
    EXPECT_NEAR(front.length(1), front.length(0), 1e-11) << noise;
    EXPECT_LE(front.trials(), 12) << noise;
  }
}

/// The same where one of them is below its toughness without growth, as in the first step with growth.
TEST(Front, ATipThatIsHardlyLessLoadedGrowsToo) {
  ClosedForm form{{0.3, 0.299}, {tip(0.4), tip(-2.0)}};
  form.own = 0;
  for (const double less : {0.3, 0.2996}) {
    form.rise = {0.3 - less, 0.2994 - less};
    const Front front = form.solved(options());
    ASSERT_EQ(front.verdict(), Front::Verdict::found) << less;
    EXPECT_NEAR(front.length(1), front.length(0), 1e-11) << less;
  }
}

/// A difference beyond the error of a mesh counts: in tougher rock a tip rests, however little the effects of the two
/// advances differ.
TEST(Front, ATipThatIsClearlyLessLoadedRests) {
  ClosedForm form{{0.3, 0.25}, {tip(0.4), tip(-2.0)}};
  form.own = 0;
  const Front front = form.solved(options());
  ASSERT_EQ(front.verdict(), Front::Verdict::found);
  EXPECT_NEAR(front.length(0), 0.008 + 0.3 / form.shared, 2e-8);
  EXPECT_EQ(front.length(1), 0.008);
}

/// In between the advances differ continuously: where K of both depends on the sum of the advances alone, the loads
/// differ by D, the advances by d with D - 2e = H(d), and sum w r = 0 is a quadratic equation for their sum.
TEST(Front, AdvancesFollowADifferenceContinuously) {
  const double error = options().mesh_error;
  for (const double difference : {0.0019, 0.0021, 0.003, 0.0035}) {
    ClosedForm form{{0.3 + difference / 2, 0.3 - difference / 2}, {tip(0.4), tip(-2.0)}};
    form.own = 0;
    const Front front = form.solved(options());
    ASSERT_EQ(front.verdict(), Front::Verdict::found) << difference;
    const double used = std::max(0.0, difference / (2 * error) - 1), apart = 0.2 * used / (1 - used);
    const double slope = form.shared * options().increment;
    const double sum = (0.3 + std::sqrt(0.09 + 2 * slope * apart * difference)) / (2 * slope);
    // The tolerance of differences over the slope of H.
    const double bound = 2e-8 * (0.2 + apart) * (0.2 + apart) / (2 * error * 0.2) + 1e-9;
    EXPECT_NEAR((front.length(0) - front.length(1)) / options().increment, apart, bound) << difference;
    EXPECT_NEAR((front.length(0) + front.length(1) - 0.016) / options().increment, sum, 4e-6) << difference;
  }
}

/// Tips that unload themselves more than others are nearly at their toughness, and share the energy exactly.
TEST(Front, TipsAreNearlyAtTheirToughness) {
  for (const std::vector<double>& rise :
       {std::vector<double>{0.3, 0.33}, {0.33, 0.3}, {0.3, 0.301}, {0.3, 0.32, 0.31}, {0.3, 0.1}}) {
    const std::vector<FrontTip> tips{tip(0.4), tip(-2.0), tip(1.1)};
    ClosedForm form{rise, {tips.begin(), tips.begin() + static_cast<long>(rise.size())}};
    form.shared = 10;
    const Front front = form.solved(options());
    ASSERT_EQ(front.verdict(), Front::Verdict::found) << rise[1];
    std::vector<double> lengths, angles;
    for (std::size_t i = 0; i < rise.size(); ++i) {
      lengths.push_back(front.length(static_cast<int>(i)));
      angles.push_back(front.angle(static_cast<int>(i)));
    }
    double energy = 0;
    const std::vector<FrontState> states = form.states(lengths, angles);
    for (std::size_t i = 0; i < rise.size(); ++i) {
      const double load = std::log(states[i].load), advance = (lengths[i] - 0.008) / 0.01;
      energy += advance * load;
      EXPECT_LE(load, 4 * options().mesh_error) << rise[1];
      if (advance > 0) {
        EXPECT_GE(load, -4 * options().mesh_error) << rise[1];
      }
    }
    EXPECT_NEAR(energy, 0, 2e-7) << rise[1];
  }
}

/// Growth of both or of one of two tips begins without a load for which no front is found, and the front depends on the
/// load continuously. Steps of 1e-5 in the load move a front by less than the least slope allows.
TEST(Front, BeginsContinuously) {
  for (const double difference : {0.0005, 0.0019, 0.0021, 0.005, 0.02}) {
    for (const double own : {0.0, 20.0}) {
      double last = 0;
      for (double rise = -0.003; rise < 0.006; rise += 1e-4) {
        ClosedForm form{{rise, rise - difference}, {tip(0.4), tip(-2.0)}};
        form.own = own;
        const Front front = form.solved(options());
        ASSERT_EQ(front.verdict(), Front::Verdict::found) << rise << ' ' << difference << ' ' << own;
        const double sum = (front.length(0) + front.length(1) - 0.016) / 0.01;
        EXPECT_GE(sum, last - 1e-5) << rise << ' ' << difference << ' ' << own;
        last = sum;
      }
    }
  }
}

/// Where the advances are well determined, the difference counts to the last digit; twins are equal.
TEST(Front, RoundOffDoesNotPartTwins) {
  const ClosedForm form{{0.3, 0.3 + 1e-12}, {tip(0.4), tip(-2.0)}};
  const Front front = form.solved(options());
  ASSERT_EQ(front.verdict(), Front::Verdict::found);
  EXPECT_NEAR(front.length(0), front.length(1), 1e-14);
}

/// The second tip would have to become shorter: it rests, and the first one takes all the fluid.
TEST(Front, LetsATipRestThatTheOtherUnloads) {
  const ClosedForm form{{0.3, 0.05}, {tip(0.4), tip(-2.0)}};
  const Front front = form.solved(options());
  ASSERT_EQ(front.verdict(), Front::Verdict::found);
  EXPECT_NEAR(front.length(0) - 0.008, 0.3 / (form.own + form.shared), 2e-8);
  EXPECT_EQ(front.length(1), 0.008);
  EXPECT_EQ(front.angle(1), -2.0);
}

/// Slopes that were learnt under other loads may be of no use: by those given here K would rise with the length.
TEST(Front, ForgetsExperienceThatMisleads) {
  const ClosedForm form{{0.3, 0.33}, {tip(0.4), tip(-2.0)}};
  const Front front = form.solved(exact(), -form.solved(exact()).slopes());
  ASSERT_EQ(front.verdict(), Front::Verdict::found);
  const double sum = 0.63 / (form.own + 2 * form.shared);
  EXPECT_NEAR(front.length(0) - 0.008, (0.3 - form.shared * sum) / form.own, 2e-8);
}

/// The load falls during the step: tips that were taken to go on rest.
TEST(Front, TipsThatWereTakenToGoOnMayRest) {
  ClosedForm form{{-0.01, -0.02}, {tip(0.4), tip(-2.0)}};
  for (FrontTip& tip : form.tips) {
    tip.speed = 1e-6;
    tip.goes_on = true;
  }
  const Front front = form.solved(options());
  ASSERT_EQ(front.verdict(), Front::Verdict::found);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(front.length(i), 0.008);
}

/// A tip that starts hardly above its toughness, with slopes that are known, advances in the first trial by what they
/// foretell: K of a short wing falls ten times as fast as that of a long one, and a trial of a quarter of an increment
/// would lead far beyond the front.
TEST(Front, TheFirstTrialFollowsSlopesThatAreKnown) {
  ClosedForm form{{0.3, 0.33}, {tip(0.4), tip(-2.0)}};
  form.own = 200;
  const Eigen::MatrixXd slopes = form.solved(exact()).slopes();
  form.rise = {0.01, -0.1};
  const Front begin(form.tips, form.without_growth(), exact(), 3600, slopes);
  EXPECT_NEAR(begin.length(0) - 0.008, 0.01 / (form.own + form.shared), 0.1 * 0.01 / (form.own + form.shared));
  const Front front = form.solved(exact(), slopes);
  ASSERT_EQ(front.verdict(), Front::Verdict::found);
  EXPECT_NEAR(front.length(0) - 0.008, 0.01 / (form.own + form.shared), 1e-9);
  EXPECT_LE(front.trials(), 5);
}

/// Factors that jump by 3e-6 and 3e-5 wherever a trial comes near the front: no trial meets the tolerances, and the
/// front is found to the size of the jumps. Where they jump by a hundred times as much, there is none.
TEST(Front, IsFoundToTheStepsOfTheFactors) {
  for (const double size : {1.0, 100.0}) {
    const ClosedForm form{{0.3, 0.33}, {tip(0.4), tip(-2.0)}};
    Front front(form.tips, form.without_growth(), exact(), 3600);
    int trial = 0;
    while (front.verdict() == Front::Verdict::again) {
      std::vector<FrontState> states =
          form.states({front.length(0), front.length(1)}, {front.angle(0), front.angle(1)});
      const double sign = ++trial % 2 == 0 ? size : -size;
      for (FrontState& state : states) {
        state.sifs.k2 += sign * 3e-5 * state.sifs.k1;
        state.load *= 1 + sign * 3e-6;
      }
      front.learn(states);
    }
    ASSERT_EQ(front.verdict(), size > 1 ? Front::Verdict::failed : Front::Verdict::found);
    if (size > 1) continue;
    EXPECT_TRUE(front.is_rough());
    EXPECT_GT(front.worst_shear(), options().direction_tolerance);
    EXPECT_LT(front.worst_shear(), 1e-4);
    const double sum = 0.63 / (form.own + 2 * form.shared);
    EXPECT_NEAR(front.length(0) - 0.008, (0.3 - form.shared * sum) / form.own, 1e-5 / form.own);
  }
  EXPECT_FALSE((ClosedForm{{0.3}, {tip(0.4)}}.solved(options()).is_rough()));
}

TEST(Front, NothingGrowsBelowTheToughness) {
  const Front front = ClosedForm{{-0.01, -0.2}, {tip(0.4), tip(-2.0)}}.solved(options());
  EXPECT_EQ(front.verdict(), Front::Verdict::found);
  EXPECT_EQ(front.trials(), 0);
  EXPECT_FALSE(front.any_grows());
}

/// On the mesh of the trials K_eq is lower by 0.2 % than on that of the step without growth, where it is above the
/// toughness.
TEST(Front, ATipRestsOnTheMeshOfItsTrials) {
  const ClosedForm form{{-0.001}, {tip(0.4)}}, before{{0.001}, {tip(0.4)}};
  Front front(form.tips, before.without_growth(), options(), 3600);
  while (front.verdict() == Front::Verdict::again) front.learn(form.states({front.length(0)}, {front.angle(0)}));
  ASSERT_EQ(front.verdict(), Front::Verdict::found);
  EXPECT_EQ(front.length(0), 0.008);
  EXPECT_TRUE(front.is_laid(0));
  EXPECT_FALSE(front.grows(0));
}

/// A tip that came back to where it was, since the load fell too far in the first trials, grows from there.
TEST(Front, ATipThatCameBackGrowsAgain) {
  const std::vector<FrontTip> tips{tip(0.4)};
  Front front(tips, ClosedForm{{0.0005}, tips}.without_growth(), options(), 3600);
  bool has_rested = false;
  while (front.verdict() == Front::Verdict::again) {
    has_rested = has_rested || front.length(0) == 0.008;
    const ClosedForm form{{has_rested ? 0.002 : -0.1}, tips};
    front.learn(form.states({front.length(0)}, {front.angle(0)}));
  }
  ASSERT_EQ(front.verdict(), Front::Verdict::found);
  EXPECT_TRUE(has_rested);
  EXPECT_NEAR(front.length(0), 0.008 + 0.002 / 50, 1e-8);
}

TEST(Front, DependsSmoothlyOnTheLoad) {
  const auto length = [](double rise) {
    return ClosedForm{{rise, 0.33}, {tip(0.4), tip(-2.0)}}.solved(exact()).length(0);
  };
  const double slope = (1 - 30 / 80.0) / 20;
  EXPECT_NEAR(length(0.3 + 1e-5) - length(0.3), slope * 1e-5, 2e-8);
}

TEST(Front, TellsAdvanceThatIsTooFar) {
  EXPECT_EQ((ClosedForm{{3}, {tip(0.4)}}.solved(options()).verdict()), Front::Verdict::too_far);
}

/// The part of earlier steps neither heals nor turns: a new segment that does not grow is finished, although K_II does
/// not vanish at its end.
TEST(Front, ANewSegmentRestsWhereItHasParted) {
  FrontTip start = tip(0.1);
  start.covered = 0;
  start.least = 0.006;
  start.first_length = 0.02;
  start.first_angle = 0.3;
  const auto at = [](double length) {
    FrontState state;
    state.load = std::exp(-0.03 - 20 * (length - 0.006));
    state.sifs = {7e5 * state.load, -5e4 * state.load, -1e6};
    return std::vector<FrontState>{state};
  };
  Front front({start}, at(0.006), options(), 3600);
  while (front.verdict() == Front::Verdict::again) front.learn(at(front.length(0)));
  ASSERT_EQ(front.verdict(), Front::Verdict::found) << front.reason();
  EXPECT_EQ(front.length(0), 0.006);
  EXPECT_EQ(front.angle(0), 0.3);
  EXPECT_TRUE(front.is_laid(0));
  EXPECT_FALSE(front.grows(0));
  EXPECT_LE(front.trials(), 4);
}

TEST(Front, TellsALoadThatRisesWithTheLength) {
  ClosedForm form{{0.01}, {tip(0.4)}};
  form.own = -20;
  form.shared = 0;
  const Front front = form.solved(options());
  EXPECT_NE(front.verdict(), Front::Verdict::found);
  EXPECT_LE(front.trials(), 10);
}

TEST(Front, AStoppedTipStays) {
  const ClosedForm form{{0.3, 0.33}, {tip(0.4), tip(-2.0)}};
  Front front(form.tips, form.without_growth(), options(), 3600);
  front.stop(1);
  EXPECT_FALSE(front.grows(1));
  EXPECT_EQ(front.length(1), 0.008);
}

}  // namespace
}  // namespace sprekk::fine_fracture
