#include "tests/verification/scene_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "framework/config/yaml/load_scene.hpp"
#include "framework/config/yaml/parse_yaml.hpp"
#include "framework/scene/start_state.hpp"

namespace sprekk::testing {

namespace {

Scene read(const std::string& config, const std::vector<Override>& overrides) {
  const std::filesystem::path file = std::filesystem::path(SPREKK_SOURCE_DIR) / "configs" / config;
  return read_scene(load_scene({file.string()}, overrides), file.parent_path().string());
}

}  // namespace

SceneRun::SceneRun(const std::string& config, const std::vector<Override>& overrides)
    : SceneRun(read(config, overrides)) {}

SceneRun SceneRun::from_text(const std::string& yaml) { return SceneRun(read_scene(parse_yaml(yaml, "test"), ".")); }

SceneRun::SceneRun(const Scene& scene) {
  model_ = std::make_unique<Model>(scene);
  take_start(*model_);
  std::vector<double> targets = model_->switch_times();
  targets.insert(targets.end(), scene.output.times.begin(), scene.output.times.end());
  controller_ = std::make_unique<StepController>(scene.time, targets);
  growth_ = std::make_unique<MeshGrowth>(model_, *controller_);
}

bool SceneRun::step() {
  for (;;) {
    const StepTime step = controller_->next(growth_->longest_step());
    const StepStatus status = growth_->attempt(step);
    if (status.converged && growth_->before_acceptance() == MeshGrowth::Outcome::changed) continue;
    if (status.converged) {
      iterations_ = status.iterations;
      model_->accept();
      controller_->accepted(step, status.effort());
      if (growth_->after_acceptance() != MeshGrowth::Outcome::failed) return true;
      ADD_FAILURE() << growth_->reason();
      return false;
    }
    model_->rewind();
    if (!controller_->rejected(step, status.retry_dt)) {
      ADD_FAILURE() << "t = " << step.end << " s: " << status.reason;
      return false;
    }
  }
}

void SceneRun::run_until(double time, const std::function<void()>& after_step) {
  while (controller_->time() < time * (1 - 1e-12)) {
    if (!step()) return;
    if (after_step) after_step();
  }
}

double SceneRun::quantity(const std::string& name) const {
  for (const Quantity& quantity : model_->quantities())
    if (quantity.name == name) return quantity.value;
  throw std::out_of_range("no quantity " + name);
}

LinearCounts SceneRun::linear_counts() const {
  LinearCounts counts;
  model_->schedule().add_counts(counts);
  return counts;
}

std::vector<std::vector<double>> read_numbers(const std::string& file) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error("cannot read " + file);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(stream, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::vector<double> row;
    std::stringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
    rows.push_back(std::move(row));
  }
  return rows;
}

double relative_error(const Vector& weights, const Vector& values, const Vector& reference) {
  const Vector difference = values - reference;
  return std::sqrt(weights.dot(difference.cwiseAbs2()) / weights.dot(reference.cwiseAbs2()));
}

}  // namespace sprekk::testing
