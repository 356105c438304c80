// Fills run.json while a run goes on.
#pragma once

#include <string>
#include <vector>

#include "framework/output/run_record.hpp"
#include "framework/run/early_end.hpp"
#include "framework/run/exit_code.hpp"
#include "framework/run/mesh_growth.hpp"
#include "framework/run/simulation_state.hpp"

namespace sprekk {

/// Collects the content of run.json.
class RunRecorder {
 public:
  /// The time of the set-up begins now.
  explicit RunRecorder(std::vector<std::string> scene_files);
  void set_up_ends();  ///< the time of the run begins now

  /// Records what is known before the first step: the scene, the mesh, the unknowns, the notes.
  void begin(const Model& model);
  void accepted(const std::vector<Quantity>& quantities);  ///< at the end of a step
  void note_topology(const Model& model, double time);     ///< at the end of a step, before it is accepted
  void note_splitting_errors(const std::map<std::string, double>& errors);  ///< by fields, at the end of a step
  /// Records how the run has ended. `reason`: why it has not come to its end; "" when it has.
  void end(ExitCode code, const std::string& reason, const Scene& scene, const EarlyEnd& early);
  void add(const MeshGrowth& growth);
  /// Records notes and times; `profile` must be complete.
  void close(const Notes& step_notes, const Profile& profile);
  /// Records that the run ends because something could not be written.
  void fail(const std::string& reason);

  const RunRecord& record() const { return record_; }
  RunRecord& record() { return record_; }

 private:
  RunRecord record_;
  Notes start_notes_;  ///< at the end also on requests that had no effect
  std::vector<Quantity> last_quantities_;
  long steps_ = 0;
  double processor_at_start_, processor_after_set_up_ = 0, began_ = 0;  ///< s
};

}  // namespace sprekk
