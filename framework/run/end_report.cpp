#include "framework/run/end_report.hpp"

#include <iostream>

#include "framework/parallel/parallel.hpp"
#include "framework/run/exit_code.hpp"

namespace sprekk {

void report_end(const RunRecord& record, const Profile& profile, const SimulationState& state, const RunOutput& output,
                bool is_quiet) {
  if (!parallel::is_root()) return;
  const bool is_done = record.exit_code == static_cast<int>(ExitCode::done);
  if (!is_quiet) std::cerr << profile.table(record.seconds) << "\n";
  for (const NoteRecord& note : record.notes) std::cerr << "note: " << described(note) << "\n";
  if (!is_quiet && is_done && record.counters.at("steps accepted") == 0)
    std::cerr << "nothing was to be done: the run ended at t = " << state.controller.time()
              << " s before, and time.end is " << state.model->scene().time.end << " s\n";
  if (!is_done) std::cerr << record.exit_reason << "\nthe checkpoint is " << output.checkpoint_path().string() << "\n";
  if (!is_quiet) std::cout << "results: " << output.path().string() << "\n";
}

void report_last_checkpoint(const RunOutput& output) {
  if (!parallel::is_root()) return;
  std::error_code error;
  if (std::filesystem::exists(output.checkpoint_path(), error))
    std::cerr << "once that is mended, the run can go on from its last checkpoint, "
              << output.checkpoint_path().string() << ", with --restart\n";
}

}  // namespace sprekk
