// The checkpoints that a run writes.
#pragma once

#include <map>
#include <string>

#include "framework/run/run_output.hpp"
#include "framework/run/simulation_state.hpp"

namespace sprekk {

/// Writes a checkpoint from time to time, and when the run ends. A run can be continued from the last one.
class Checkpoints {
 public:
  /// Both must outlive this object. The interval counts from now on.
  Checkpoints(const SimulationState& state, RunOutput& output, std::string fingerprint);

  void step_begins();  ///< the next step starts from the present state
  void write();        ///< of the accepted state. Collective
  /// Writes the state at step_begins(), for a step that has been given up and rewound. Collective
  void write_begin_of_step();
  void write_if_due();  ///< Collective

 private:
  /// The state that a step changes and Model::rewind does not restore.
  struct Moment {
    std::map<std::string, Vector> steps;  ///< of the controller
    RunOutput::Rows rows;
  };
  Moment now() const;
  void write(const Moment& moment);

  const SimulationState& state_;
  RunOutput& output_;
  std::string fingerprint_;
  Moment begin_of_step_;
  double began_, last_;  ///< s, on the clock of Progress
  double cost_ = 0;      ///< s, of writing the last one
};

}  // namespace sprekk
