// When growth lets a step pass, what it refuses, and what it hands on.
#include "framework/schedule/grow_step.hpp"
#include "framework/config/yaml/parse_yaml.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "framework/meshing/generate_mesh.hpp"
#include "framework/schedule/schedule_context.hpp"
#include "tests/framework/config/messages.hpp"

namespace sprekk {
namespace {

using testing::HasSubstr;

class Still : public Part {
 public:
  void begin_step(const StepTime&) override {}
  void assemble(Assembly&, const StepTime&) const override {}
};

/// Tips whose behaviour the test sets.
class Tips : public Still, public Growing {
 public:
  Load examine(const StepTime&) override {
    if (is_unsolved) throw UnsolvedGrowth("no answer");
    return load;
  }
  void examine_followed(const StepTime&) override { ++examined_in_trials; }
  Growth grow(const StepTime&) override {
    ++grown;
    return growth;
  }
  bool may_grow_within_steps() const override { return may_be_within; }
  void grow_within_steps() override { is_within = true; }
  void hold(bool is_held) override { holds = is_held; }
  bool is_far_above() const override { return far_above; }
  bool grows_on() const override { return false; }
  double longest_step() const override { return std::numeric_limits<double>::infinity(); }
  std::unique_ptr<FrontSearch> search_front(const StepTime&, bool, bool) override { return nullptr; }
  CavityOptions cavity() const override { return {.radius = 0.3, .size = 0.1, .growth = 0.4}; }

  Load load;
  Growth growth;
  int grown = 0, examined_in_trials = 0;
  bool may_be_within = false, is_within = false, holds = false, far_above = false, is_unsolved = false;
};

Mesh two_cells() {
  Geometry geometry;
  geometry.box.high = Point(1, 1);
  MeshOptions options;
  options.kind = MeshOptions::Kind::structured;
  options.cells = {1, 1};
  return generate_mesh(geometry, options);
}

constexpr double standard = 100;  // s

/// A schedule `text` for the components `tips` and `rock`, the latter with one unknown.
struct Schedule {
  explicit Schedule(const std::string& text, bool may_be_within = false) {
    tips.may_be_within = may_be_within;
    fields.add(mesh, {.owner = "rock",
                      .name = "height",
                      .location = Location::cell,
                      .role = Role::unknown(BlockKind::interface),
                      .unit = "",
                      .doc = ""});
    ScheduleReading reading;
    reading.component_names = {"rock", "tips"};
    ScheduleContext context{mesh, fields,   {&rock, &tips}, {}, {{"rock", &rock}, {"tips", &tips}},
                            0,    standard, &growing};
    schedule = read_schedule(parse_yaml(text, "scene.yaml"), reading)(context);
  }

  GrowStep& step() { return *growing.at(0); }

  Mesh mesh = two_cells();
  FieldStore fields;
  Still rock;
  Tips tips;
  std::vector<GrowStep*> growing;
  std::unique_ptr<ScheduleStep> schedule;
};

const char* const usual = "- {grow: tips, settle: [rock], cut: 0.01, overshoot: 0.02, settled: 0.05}";
const PathExtension some_extension{3, true, {Point(0.1, 0.2)}};

TEST(GrowStep, DoesNothingBelowTheLoadOfGrowth) {
  Schedule run(usual);
  run.tips.load = {.now = 1, .accepted = 0.9, .onset = 1, .onset_accepted = 0.9};
  run.tips.growth.extensions = {some_extension};
  const StepStatus status = run.schedule->run({0, standard, standard});
  EXPECT_TRUE(status.converged);
  EXPECT_EQ(status.retry_dt, 0);
  EXPECT_EQ(run.tips.grown, 0);
  EXPECT_TRUE(run.step().extensions().empty());
}

// It is cut, as one whose equations are not solved, and the run goes on.
TEST(GrowStep, WithoutAnAnswerIsAnUnsolvedStep) {
  Schedule run(usual);
  run.tips.is_unsolved = true;
  const StepStatus status = run.schedule->run({0, standard, standard});
  EXPECT_FALSE(status.converged);
  EXPECT_EQ(status.retry_dt, 0);
  EXPECT_THAT(status.reason, HasSubstr("no answer"));
}

TEST(GrowStep, HandsOnWhatHasGrown) {
  Schedule run(usual);
  run.tips.load = {.now = 1.019, .accepted = 0.9, .onset = 1.019, .onset_accepted = 0.9};
  run.tips.growth.extensions = {some_extension};
  EXPECT_TRUE(run.schedule->run({0, standard, standard}).converged);
  EXPECT_EQ(run.tips.grown, 1);
  ASSERT_EQ(run.step().extensions().size(), 1u);
  EXPECT_EQ(run.step().extensions()[0].fracture, 3);
  EXPECT_EQ(run.step().extensions()[0].points[0], Point(0.1, 0.2));
  EXPECT_EQ(run.step().cavity().radius, 0.3);
  // The extensions are those of the last run only.
  run.tips.load.now = run.tips.load.onset = 0.5;
  EXPECT_TRUE(run.schedule->run({standard, standard, 2 * standard}).converged);
  EXPECT_TRUE(run.step().extensions().empty());
}

TEST(GrowStep, RefusesAStepThatPassesTheOnset) {
  Schedule run(usual);
  run.tips.load = {.now = 1.5, .accepted = 0.6, .onset = 1.4, .onset_accepted = 0.8};
  const StepStatus status = run.schedule->run({0, standard, standard});
  EXPECT_FALSE(status.converged);
  EXPECT_THAT(status.reason, HasSubstr("1.4 times"));
  EXPECT_EQ(run.tips.grown, 0);
  // Where a load that rises linearly, from 0.8 to 1.4, is half of the overshoot above 1.
  EXPECT_NEAR(status.retry_dt, standard * (1.01 - 0.8) / (1.4 - 0.8), 1e-12 * standard);
}

TEST(GrowStep, TheSizeToRepeatAStepWithReachesTheRunFromASequence) {
  const std::string one = "{grow: tips, settle: [rock], cut: 0.01, overshoot: 0.02}";
  Schedule run("[" + one + ", " + one + "]");
  run.tips.load = {.now = 1.5, .accepted = 0.6, .onset = 1.4, .onset_accepted = 0.8};
  const StepStatus status = run.schedule->run({0, standard, standard});
  EXPECT_FALSE(status.converged);
  EXPECT_NEAR(status.retry_dt, standard * (1.01 - 0.8) / (1.4 - 0.8), 1e-12 * standard);
}

TEST(GrowStep, TheRepeatedStepReachesTheLoadAndIsTaken) {
  Schedule run(usual);
  const double before = 0.4, rate = 0.02;  // of the load, 1/s
  double dt = standard;
  for (int attempt = 0; attempt < 2; ++attempt) {
    const double load = before + rate * dt;
    run.tips.load = {.now = load, .accepted = before, .onset = load, .onset_accepted = before};
    const StepStatus status = run.schedule->run({0, dt, dt});
    EXPECT_EQ(status.converged, attempt == 1);
    if (!status.converged) dt = status.retry_dt;
  }
  EXPECT_GT(run.tips.load.now, 1);
  EXPECT_EQ(run.tips.grown, 1);
}

// A load that rises with the root of time, as where fluid diffuses: the root follows from two refusals.
TEST(GrowStep, RefusalsInARowTellHowTheLoadRises) {
  Schedule run(usual);
  double dt = standard;
  int attempts = 0;
  for (bool taken = false; !taken && attempts < 100; ++attempts) {
    const double load = 1.6 * std::sqrt(dt / standard);
    run.tips.load = {.now = load, .accepted = 0, .onset = load, .onset_accepted = 0};
    const StepStatus status = run.schedule->run({0, dt, dt});
    taken = status.converged;
    if (!taken) dt = status.retry_dt;
  }
  EXPECT_GT(run.tips.load.now, 1);
  EXPECT_EQ(attempts, 3);
}

// A load that rises with the logarithm of time, as near a well, from an unknown one at the start: two refusals tell it.
TEST(GrowStep, RefusalsInARowTellALoadThatRisesWithTheLogarithmOfTime) {
  Schedule run(usual);
  double dt = standard;
  const auto load = [](double time) { return 1.45 + 0.2 * std::log(time / standard); };
  const double onset = standard * std::exp((1.01 - 1.45) / 0.2);  // in the middle of what is accepted
  for (int refusals = 0; refusals < 2; ++refusals) {
    run.tips.load = {.now = load(dt), .accepted = 0, .onset = load(dt), .onset_accepted = 0};
    const StepStatus status = run.schedule->run({0, dt, dt});
    ASSERT_FALSE(status.converged) << dt;
    dt = status.retry_dt;
  }
  EXPECT_NEAR(dt, onset, 1e-12 * onset);
  run.tips.load.now = run.tips.load.onset = load(dt);
  EXPECT_TRUE(run.schedule->run({0, dt, dt}).converged);
}

// A load that has levelled off looks like that, too: the step does not become shorter than a tenth by it.
TEST(GrowStep, ALoadThatLevelsOffMakesNoTinySteps) {
  Schedule run(usual);
  double dt = standard;
  const double scale = standard / 10, onset = scale * std::log(3);
  for (int attempts = 0;; ++attempts) {
    ASSERT_LT(attempts, 6);
    const double load = 1.5 * (1 - std::exp(-dt / scale));
    run.tips.load = {.now = load, .accepted = 0, .onset = load, .onset_accepted = 0};
    const StepStatus status = run.schedule->run({0, dt, dt});
    if (status.converged) break;
    EXPECT_GE(status.retry_dt, 0.1 * dt);
    dt = status.retry_dt;
  }
  EXPECT_GT(dt, 0.5 * onset);
}

TEST(GrowStep, TipsThatHaveGrownBeforeDoNotRefuseAStepInWhichTheyArrest) {
  Schedule run(usual);
  run.tips.load = {.now = 1.5, .accepted = 1, .onset = 0.7, .onset_accepted = 0.5};
  run.tips.growth.extensions = {some_extension};
  EXPECT_TRUE(run.schedule->run({0, standard, standard}).converged);
  EXPECT_EQ(run.step().extensions().size(), 1u);
}

TEST(GrowStep, RefusesAStepWithMoreGrowthThanTheMeshCanFollow) {
  Schedule run(usual);
  run.tips.load = {.now = 1.5, .accepted = 0.9, .onset = 0.7, .onset_accepted = 0.5};
  run.tips.growth = {{some_extension}, false};
  const StepStatus status = run.schedule->run({0, standard, standard});
  EXPECT_FALSE(status.converged);
  EXPECT_NEAR(status.retry_dt, standard * (1.01 - 0.9) / (1.5 - 0.9), 1e-12 * standard);
  EXPECT_TRUE(run.step().extensions().empty());
  // It is taken when the load has only just been reached: smaller steps would find nothing else.
  run.tips.load.now = 1.02;
  EXPECT_TRUE(run.schedule->run({0, standard, standard}).converged);
  EXPECT_EQ(run.step().extensions().size(), 1u);
}

TEST(GrowStep, RefusesNoStepAtTheSmallestSize) {
  Schedule run(usual);
  run.tips.load = {.now = 5, .accepted = 0.9, .onset = 5, .onset_accepted = 0.9};
  run.tips.growth = {{some_extension}, false};
  const double smallest = 0.01 * standard;
  for (const double dt : {smallest, 0.5 * smallest, smallest * (1 + 1e-10)}) {
    EXPECT_TRUE(run.schedule->run({0, dt, dt}).converged);
    EXPECT_EQ(run.step().extensions().size(), 1u);
  }
  // And cuts none below it: (1.01 − 0.9)/(5 − 0.9) of 2 s is less.
  const StepStatus status = run.schedule->run({0, 2 * smallest, 2 * smallest});
  EXPECT_FALSE(status.converged);
  EXPECT_EQ(status.retry_dt, smallest);
}

TEST(GrowStep, ARetryIsAlwaysShorter) {
  Schedule run(usual);
  const double steep = 1e9, over = 1.5;
  for (const auto& [before, now] :
       {std::pair(0.999, steep), {1.4999, over}, {1.6, over}, {over, over}, {0.0, 1.0201}}) {
    run.tips.load = {.now = now, .accepted = before, .onset = now, .onset_accepted = before};
    const StepStatus status = run.schedule->run({0, standard, standard});
    EXPECT_FALSE(status.converged);
    EXPECT_GE(status.retry_dt, 0.01 * standard);
    EXPECT_LE(status.retry_dt, 0.9 * standard);
  }
}

TEST(GrowStep, SaysWhetherTheTipsHaveSettled) {
  Schedule run(usual);
  EXPECT_FALSE(run.step().is_unsettled());
  run.tips.load.unsettled = 0.051;
  run.schedule->run({0, standard, standard});
  EXPECT_TRUE(run.step().is_unsettled());
  run.tips.load.unsettled = 0.049;
  run.schedule->run({0, standard, standard});
  EXPECT_FALSE(run.step().is_unsettled());
}

TEST(GrowStep, ReadsHowTheMeshFollows) {
  EXPECT_FALSE(Schedule(usual).step().repeats_step());
  Schedule run("- {grow: tips, settle: [rock], update: repeat_step, passes: 7}");
  EXPECT_TRUE(run.step().repeats_step());
  EXPECT_EQ(run.step().options().passes, 7);
  EXPECT_EQ(run.step().describe(), "grow tips");
  EXPECT_TRUE(run.step().unknowns().empty());
}

std::string refusal(const std::string& schedule) {
  return input_error_of([&] { Schedule run(schedule); });
}

TEST(GrowStep, RefusesAComponentThatDoesNotGrow) {
  EXPECT_THAT(refusal("- {grow: rock, settle: [rock]}"),
              AllOf(HasSubstr("component 'rock' does not grow"), HasSubstr("these can grow: 'tips'")));
}

TEST(GrowStep, RefusesUnknownNames) {
  for (const char* schedule : {"- {grow: tisp, settle: [rock]}", "- {grow: tips, settle: [rock, tisp]}"}) {
    const std::string message = refusal(schedule);
    EXPECT_THAT(message, HasSubstr("tisp"));
    EXPECT_THAT(message, HasSubstr("tips"));  // what is near to it
    EXPECT_THAT(message, HasSubstr("scene.yaml:1"));
  }
}

TEST(GrowStep, RefusesToStandInFrontOfTheSolve) {
  const std::string solve = "{solve: [rock]}", grow = "{grow: tips, settle: [rock]}";
  EXPECT_THAT(refusal("[" + grow + ", " + solve + "]"), HasSubstr("'grow' stands in front of the 'solve'"));
  EXPECT_THAT(refusal("[" + grow + ", {when: 't > 5', steps: [" + solve + "]}]"), HasSubstr("scene.yaml:1:"));
  for (const std::string& schedule : {"[" + solve + ", " + grow + "]", "[" + solve + ", " + grow + ", " + solve + "]"})
    EXPECT_EQ(refusal(schedule), "no error") << schedule;
}

TEST(GrowStep, RefusesToStandInsideOfIterationsAndSubcycles) {
  const std::string inside = "{steps: [{solve: [rock]}, {grow: tips, settle: [rock]}]";
  for (const std::string& schedule : {"- iterate: " + inside + "}", "- subcycle: " + inside + ", count: 2}"})
    EXPECT_THAT(refusal(schedule), HasSubstr("'grow' stands inside of an 'iterate' or a 'subcycle'")) << schedule;
}

TEST(GrowStep, WithinStepsRefusesWhatWouldChangeItsState) {
  const std::string solve = "{solve: [rock]}", held = "{grow: tips, settle: [rock], update: after_step}",
                    within = "{grow: tips, settle: [rock], update: within_step}", late = "{when: 't > 5', steps: [";
  for (const std::string& schedule :
       {"[" + within + ", " + solve + "]", "[" + solve + ", " + within + ", " + within + "]",
        "[" + late + solve + ", " + within + "]}, " + solve + "]", "[" + within + ", " + late + solve + "]}]",
        "[" + within + ", {subcycle: {count: 2, steps: [" + solve + "]}}]"}) {
    EXPECT_THAT(refusal(schedule), HasSubstr("stands behind growth within steps")) << schedule;
    EXPECT_THAT(refusal(schedule), HasSubstr("scene.yaml:1:")) << schedule;
  }
  EXPECT_THAT(refusal("[" + late + solve + ", " + held + "]}, " + late + solve + ", " + within + "]}]"),
              HasSubstr("with and without 'within_step'"));
  // What may stand: alternatives in time.
  for (const std::string& schedule :
       {"[" + solve + ", " + within + "]", "[" + solve + ", " + held + "]",
        "[" + late + solve + ", " + within + "]}, " + late + solve + ", " + within + "]}]",
        "[{subcycle: {count: 2, steps: [" + solve + "]}}, " + within + "]"})
    EXPECT_EQ(refusal(schedule), "no error") << schedule;
}

TEST(GrowStep, IsWithinStepsWhereNothingSpeaksAgainstIt) {
  const std::string solve = "{solve: [rock]}", grow = "{grow: tips, settle: [rock], update: auto}";
  const auto is_within = [](const std::string& schedule, bool may_be) {
    Schedule run(schedule, may_be);
    EXPECT_EQ(run.tips.is_within, run.step().grows_within_step());
    return run.step().grows_within_step();
  };
  EXPECT_TRUE(is_within("[" + solve + ", " + grow + "]", true));
  EXPECT_TRUE(is_within("[{when: 't > 5', steps: [" + solve + ", " + grow + "]}]", true));
  EXPECT_FALSE(is_within("[" + solve + ", " + grow + "]", false));
  EXPECT_FALSE(is_within("[" + solve + ", " + grow + ", " + solve + "]", true));
  EXPECT_FALSE(is_within("[{when: 't > 5', steps: [" + solve + ", " + grow + "]}, " + solve + "]", true));
  EXPECT_FALSE(is_within("[" + solve + ", {grow: tips, settle: [rock], update: after_step}]", true));
  EXPECT_EQ(refusal("[" + grow + ", " + grow + "]"), "no error");
}

/// With growth within steps, tips that are far above their toughness in a step that may not be shorter grow with the
/// state held, and what they have grown is handed on.
TEST(GrowStep, HoldsTheStateWhereGrowthIsNotFollowed) {
  const char* const text = "- {grow: tips, settle: [rock], update: within_step, cut: 0.01}";
  const double shortest = 0.01 * standard;
  for (const bool far_above : {true, false})
    for (const double dt : {shortest, 2 * shortest}) {
      Schedule run(text);
      run.tips.far_above = far_above;
      run.tips.load = {.now = 1.01, .accepted = 1, .onset = 1, .onset_accepted = 1};
      run.tips.growth.extensions = {some_extension};
      for (const auto holding :
           {GrowStep::Holding::never, GrowStep::Holding::if_far_above, GrowStep::Holding::always}) {
        run.step().choose(holding);
        EXPECT_TRUE(run.schedule->run({0, dt, dt}).converged);
        const bool is_held = holding == GrowStep::Holding::always ||
                             (holding == GrowStep::Holding::if_far_above && far_above && dt == shortest);
        EXPECT_EQ(run.step().is_held(), is_held);
        EXPECT_EQ(run.tips.holds, is_held);
        EXPECT_EQ(run.step().extensions().size(), 1u);
      }
    }
}

/// In a trial of a search only the tips that are searched for are examined. Nothing grows, and nothing is refused.
TEST(GrowStep, ExaminesOnlyFollowedTipsInTrials) {
  Schedule run("- {grow: tips, settle: [rock], update: within_step}");
  run.tips.load = {.now = 1.5, .accepted = 1, .onset = 1.5, .onset_accepted = 1};
  const StepTime step{0, standard, standard};
  run.step().examine_followed_only(true);
  EXPECT_TRUE(run.schedule->run(step).converged);
  EXPECT_TRUE(run.step().was_run(step));
  EXPECT_EQ(run.tips.examined_in_trials, 1);
  EXPECT_EQ(run.tips.grown, 0);
  run.step().examine_followed_only(false);
  EXPECT_FALSE(run.schedule->run(step).converged);  // the onset is far above the toughness
  run.tips.load.onset = 1;
  EXPECT_TRUE(run.schedule->run(step).converged);
  EXPECT_EQ(run.tips.examined_in_trials, 1);
  EXPECT_EQ(run.tips.grown, 1);
}

/// A tip above its toughness that does not grow is not waited for, also where others grow at their toughness.
TEST(GrowStep, ComesToRestWhenNothingAboveItsToughnessGrows) {
  for (const double load : {1.01, 1.4})
    for (const double of_growing : {0.0, 1.01, 1.4})
      for (const bool settled : {false, true}) {
        if (of_growing > load) continue;
        Schedule run("- {grow: tips, settle: [rock], update: within_step, overshoot: 0.02, settled: 0.01}");
        run.tips.load = {.now = load, .unsettled = 0.011, .uneven = settled ? 0.009 : 0.011};
        run.tips.growth.load = of_growing;
        run.step().choose(GrowStep::Holding::always);
        EXPECT_TRUE(run.schedule->run({0, standard, standard}).converged);
        EXPECT_EQ(run.step().has_come_to_rest(), settled && of_growing < 1.02);
      }
  Schedule run("- {grow: tips, settle: [rock], update: within_step}");
  run.tips.load.now = 1.001;
  run.tips.growth.extensions = {some_extension};
  EXPECT_TRUE(run.schedule->run({0, standard, standard}).converged);
  EXPECT_FALSE(run.step().has_come_to_rest());
}

TEST(GrowStep, KnowsWhetherItWasRunForAStep) {
  Schedule run("- {when: 't > 150', steps: [{grow: tips, settle: [rock], update: within_step}]}");
  const StepTime first{0, standard, standard}, second{standard, standard, 2 * standard};
  run.schedule->run(first);
  EXPECT_FALSE(run.step().was_run(first));
  run.schedule->run(second);
  EXPECT_FALSE(run.step().was_run({standard, 2 * standard, 3 * standard}));
  EXPECT_FALSE(run.step().was_run(second));  // the condition is taken at the middle, 150 s
  const StepTime third{2 * standard, standard, 3 * standard};
  run.schedule->run(third);
  EXPECT_TRUE(run.step().was_run(third));
}

TEST(GrowStep, RefusesOptionsWithoutSense) {
  for (const char* option : {"cut: 0", "cut: 1.5", "settled: 0", "overshoot: -1", "passes: 0", "update: never"})
    EXPECT_NE(refusal(std::string("- {grow: tips, settle: [rock], ") + option + "}"), "no error") << option;
  EXPECT_NE(refusal("- {grow: tips}"), "no error");
}

}  // namespace
}  // namespace sprekk
