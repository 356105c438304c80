// What a run has cost: attempts, iterations, and what its models have counted and timed.
#pragma once

#include <map>
#include <string>

#include "framework/output/run_record.hpp"
#include "framework/scene/model.hpp"

namespace sprekk {

class Effort {
 public:
  void attempted(const StepStatus& status) { iterations_ += status.iterations; }
  void rejected() { ++rejected_; }
  /// A change of the mesh has replaced `before`, whose counts are final; `after` has solved for nothing but its
  /// settling.
  void mesh_changed(const Model& before, const Model& after);

  /// Adds all to the record, and to the profile the time of what the models have timed inside of "steps" and of "change
  /// of mesh", which is taken from these. `last`: the model at the end. To be called once.
  void finish(const Model& last, RunRecord& record, Profile& profile);

 private:
  void retire(const Model& model);
  void split_times(Profile& profile) const;

  long iterations_ = 0, rejected_ = 0;
  LinearCounts linear_;
  std::map<std::string, long> counts_;  ///< of parts, by name
  Profile efforts_;                     ///< of parts that are timed inside of steps
  double settling_seconds_ = 0;         ///< of linear solvers during changes of the mesh
};

}  // namespace sprekk
