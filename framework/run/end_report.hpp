// The output on the terminal at the end of a run.
#pragma once

#include "framework/output/run_record.hpp"
#include "framework/run/run_output.hpp"
#include "framework/run/simulation_state.hpp"

namespace sprekk {

/// Prints the profile, the notes, why the run ended where it did, and where its checkpoint and results are. `record`
/// must be complete. On the first process only.
void report_end(const RunRecord& record, const Profile& profile, const SimulationState& state, const RunOutput& output,
                bool is_quiet);

/// For a run whose results cannot be written any more: prints where its last checkpoint is. On the first process only.
void report_last_checkpoint(const RunOutput& output);

}  // namespace sprekk
