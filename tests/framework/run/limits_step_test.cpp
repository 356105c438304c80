// A part that bounds the length of time steps, in whole runs.
#include "framework/schedule/limits_step.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <string>

#include "framework/config/yaml/load_scene.hpp"
#include "framework/run/simulation.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk {
namespace {

struct DecayOptions {
  double rate = 1, part = 0.5;
  double from = -1;
  double largest_change = 10;
  Spec spec() {
    Spec spec("test/decay", "Decays with a rate, explicitly in time.");
    spec.ignore("type");
    spec.quantity("rate", rate, {.unit = "1/s", .doc = "The rate."});
    spec.quantity("part", part, {.doc = "Longest step over the time of decay."});
    spec.quantity("largest_change", largest_change, {.doc = "Of y in a step that is accepted."});
    spec.quantity("from", from, {.unit = "s", .doc = "When steps are limited."});
    return spec;
  }
};

/// y − y_old + dt rate y_old = 0 in each cell, from 1: steps above 2/rate diverge.
class Decay : public Component, public LimitsStep {
 public:
  Decay(const ComponentContext& context, const DecayOptions& options)
      : Component(context.name),
        mesh_(context.mesh),
        options_(options),
        y_(context.fields.add(mesh_, {.owner = context.name,
                                      .name = "y",
                                      .location = Location::cell,
                                      .role = Role::unknown(BlockKind::bulk_elliptic),
                                      .unit = "1",
                                      .doc = "What decays"})),
        one_(diagonal_matrix(Vector::Ones(mesh_.cell_count()))) {
    y_.set_both(Vector::Ones(mesh_.cell_count()));
  }
  void begin_step(const StepTime&) override {}
  void assemble(Assembly& assembly, const StepTime& step) const override {
    if (!assembly.has_row(y_)) return;
    assembly.add(y_, y_.now() - (1 - step.dt * options_.rate) * y_.accepted());
    assembly.derivative(y_, y_, one_);
  }
  double longest_step(double start) const override {
    return start < options_.from ? std::numeric_limits<double>::infinity() : options_.part / options_.rate;
  }
  std::optional<StepTooLong> too_long(const StepTime& step) const override {
    const double change = std::abs(y_.now()[0] - y_.accepted()[0]);
    if (change <= options_.largest_change) return std::nullopt;
    return StepTooLong{0.5 * step.dt, "y has changed by too much"};
  }
  void report(std::vector<Quantity>& quantities) const override { quantities.push_back({"y", "1", y_.now()[0]}); }

 private:
  const Mesh& mesh_;
  DecayOptions options_;
  Field& y_;
  Operator one_;
};

const RegisterComponent<Decay, DecayOptions> registration("test/decay");

struct Result {
  ExitCode code;
  int steps = 0;
  double y = 0, last_time = 0, longest = 0;
};

/// A run over 1 s with a rate of 10 /s.
Result run_of(const std::string& component, const std::string& time) {
  const auto folder = std::filesystem::temp_directory_path() /
                      ("sprekk_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "scene.yaml")
      << "{geometry: {box: {x: [0 m, 1 m], y: [0 m, 1 m]}}, mesh: {kind: structured, cells: "
         "[1, 1], shape: quadrilaterals}, components: {decay: {type: test/decay, rate: 10 "
         "1/s" +
             component + "}}, schedule: [{solve: decay}], time: {end: 1 s, " + time +
             "}, output: {every: 0.5 s, fields: false}}";
  Result run{run_scene(read_scene(load_scene({(folder / "scene.yaml").string()}, {}), folder.string()),
                       {.scene_files = {}, .folder = folder / "run", .checkpoint = {}, .quiet = true})};
  std::ifstream history(folder / "run/history.csv");
  std::string line;
  std::getline(history, line);
  while (std::getline(history, line)) {
    ++run.steps;
    run.last_time = std::stod(line);
    run.longest = std::max(run.longest, std::stod(line.substr(line.find(',') + 1)));
    run.y = std::stod(line.substr(line.rfind(',') + 1));
  }
  std::filesystem::remove_all(folder);
  return run;
}

TEST(LimitsStep, StepsAreNoLongerThanAPartAllows) {
  // Twenty steps of 0.05 s, which also end at the times of output.
  const Result run = run_of("", "step: 1 s");
  EXPECT_EQ(run.code, ExitCode::done);
  EXPECT_EQ(run.steps, 20);
  EXPECT_NEAR(run.longest, 0.05, 1e-15);
  EXPECT_NEAR(run.y, std::pow(0.5, 20), 1e-12);
  EXPECT_EQ(run.last_time, 1);
}

TEST(LimitsStep, AShorterStepOfTheSceneStays) {
  const Result run = run_of("", "step: 0.025 s");
  EXPECT_EQ(run.steps, 40);
  EXPECT_NEAR(run.y, std::pow(0.75, 40), 1e-12);
}

TEST(LimitsStep, TheLimitMayChangeInTime) {
  // One step to the first output, without a limit: (1 − 5); then ten of 0.05 s.
  const Result run = run_of(", from: 0.4 s", "step: 1 s");
  EXPECT_EQ(run.steps, 11);
  EXPECT_NEAR(run.y, -4 * std::pow(0.5, 10), 1e-12);
}

TEST(LimitsStep, ALimitBelowTheSmallestStepEndsTheRun) {
  const Result run = run_of(", part: 0.1", "step: 1 s, smallest: 0.02 s");
  EXPECT_NE(run.code, ExitCode::done);
  EXPECT_EQ(run.steps, 0);
}

TEST(LimitsStep, AStepThatHasConvergedMayBeTooLong) {
  // 0.05 s would change y from 1 by 0.5; half of it changes it by 0.25, and by less in all steps after it.
  const Result run = run_of(", largest_change: 0.3", "step: 1 s");
  EXPECT_EQ(run.code, ExitCode::done);
  EXPECT_EQ(run.last_time, 1);
  EXPECT_GT(run.steps, 20);
  EXPECT_LT(run.longest, 0.05 + 1e-12);
  EXPECT_GT(run.y, std::pow(0.5, 20) * 1.1);  // (1 - 0.25)^2 > 0.5
}

TEST(LimitsStep, AStepThatIsTooLongHoweverShortEndsTheRun) {
  const Result run = run_of(", largest_change: 0.01", "step: 1 s, smallest: 0.02 s");
  EXPECT_NE(run.code, ExitCode::done);
  EXPECT_EQ(run.steps, 0);
}

}  // namespace
}  // namespace sprekk
