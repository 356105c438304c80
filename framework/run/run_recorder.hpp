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

class RunRecorder {
 public:
  /// The time of the set-up counts from now on.
  explicit RunRecorder(std::vector<std::string> scene_files);
  void set_up_ends();  ///< the time of the run counts from now on

  /// What is known before the first step: the scene, the mesh, the unknowns, the notes.
  void begin(const Model& model);
  void accepted(const std::vector<Quantity>& quantities);  ///< at the end of a step
  /// `reason`: why the run has not come to its end; nothing when it has.
  void end(ExitCode code, const std::string& reason, const Scene& scene, const EarlyEnd& early);
  void add(const MeshGrowth& growth);
  /// What is said and timed at the end; `profile` is complete.
  void close(const Notes& step_notes, const Profile& profile);
  /// The run ends because something could not be written.
  void fail(const std::string& reason);

  const RunRecord& record() const { return record_; }
  RunRecord& record() { return record_; }

 private:
  RunRecord record_;
  Notes start_notes_;  ///< and, at the end, on what was asked for and did not happen
  std::vector<Quantity> last_quantities_;
  long steps_ = 0;
  double processor_at_start_, processor_after_set_up_ = 0, began_ = 0;  ///< s
};

}  // namespace sprekk
