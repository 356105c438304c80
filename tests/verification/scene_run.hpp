// Runs scenes inside a test, without output, and looks at their fields.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "framework/config/node.hpp"
#include "framework/config/yaml/load_scene.hpp"
#include "framework/run/mesh_growth.hpp"
#include "framework/scene/model.hpp"
#include "framework/schedule/step_controller.hpp"

namespace sprekk::testing {

/// A scene of configs/, with overrides ("path", "value as YAML").
class SceneRun {
 public:
  explicit SceneRun(const std::string& config, const std::vector<Override>& overrides = {});

  /// A scene given as YAML text.
  static SceneRun from_text(const std::string& yaml);

  Model& model() { return *model_; }
  const Mesh& mesh() const { return model_->mesh(); }
  const Vector& field(const std::string& name) const { return model_->fields().at(name).now(); }
  double time() const { return controller_->time(); }
  int steps() const { return controller_->steps(); }
  int iterations() const { return iterations_; }  ///< of the last step

  /// One accepted step; fails the test with the reason when it does not converge.
  bool step();
  long mesh_changes() const { return growth_->changes(); }
  long trials() const { return growth_->trials(); }  ///< of growth within steps
  /// Steps until the time (s) is reached; `after_step` may be empty.
  void run_until(double time, const std::function<void()>& after_step = {});
  void run() { run_until(model_->scene().time.end); }
  /// A column of history.csv, without its unit.
  double quantity(const std::string& name) const;
  LinearCounts linear_counts() const;

 private:
  explicit SceneRun(const Scene& scene);
  SceneRun(const SceneRun&) = delete;
  std::unique_ptr<Model> model_;
  std::unique_ptr<StepController> controller_;
  std::unique_ptr<MeshGrowth> growth_;
  int iterations_ = 0;
};

/// Rows of a CSV file of numbers; lines that start with # are left out.
std::vector<std::vector<double>> read_numbers(const std::string& file);

/// Relative L2 norm of a difference, weighted.
double relative_error(const Vector& weights, const Vector& values, const Vector& reference);

}  // namespace sprekk::testing
