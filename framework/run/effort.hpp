// The effort of a run: attempts, iterations, and the counts and times of its models.
#pragma once

#include <map>
#include <string>

#include "framework/output/run_record.hpp"
#include "framework/scene/model.hpp"

namespace sprekk {

/// Adds up the effort of a run, over all models that changes of the mesh have made.
class Effort {
 public:
  void attempted(const StepStatus& status) { iterations_ += status.iterations; }
  void rejected() { ++rejected_; }
  /// A model is not used any more: its counts are final. `settled`: its successor, which has solved for nothing but its
  /// settling on a changed mesh, or null where there is none.
  void retired(const Model& model, const Model* settled);

  /// Adds all counts to the record, and to the profile the times of the models' work. These times lie inside of "steps"
  /// and of "change of mesh", and are subtracted there. `last`: the model at the end. To be called once.
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
