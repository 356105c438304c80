// Everything that a run writes into its folder. Does nothing on processes other than the first.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "framework/assembly/tells_events.hpp"
#include "framework/frame_output/registry.hpp"
#include "framework/output/checkpoint.hpp"
#include "framework/output/output_folder.hpp"
#include "framework/output/run_lock.hpp"
#include "framework/output/run_record.hpp"
#include "framework/output/table_writer.hpp"
#include "framework/scene/model.hpp"
#include "framework/schedule/schedule_step.hpp"

namespace sprekk {

/// Writes the tables, fields and checkpoints of a run.
class RunOutput {
 public:
  explicit RunOutput(OutputFolder folder) : folder_(std::move(folder)) {}

  /// For a run that is continued: locks the folder against other runs. Throws InputError when another run has locked
  /// it. Collective.
  void lock();
  /// The tables, and their numbers of rows.
  enum Table { history, coupling, events };
  using Rows = std::array<long, 3>;
  /// The point from which a run is continued: time and rows of the tables when the checkpoint was written.
  struct Continued {
    double time;               ///< s
    std::optional<Rows> rows;  ///< older checkpoints have none
  };
  static Continued continued(const Checkpoint& checkpoint, double time);

  /// Creates the folder and locks it, or continues the tables that are in it. Throws InputError when another run has
  /// locked the folder, or when a table is missing. Collective.
  void open(const std::optional<Continued>& from, const std::vector<FrameOutputChoice>& outputs);
  void write_history(const StepTime& step, int iterations, const std::vector<Quantity>& quantities);
  /// `figures`: all that events of this scene may have; the table appears with the first event.
  void write_events(const StepTime& step, const std::vector<Event>& events, const std::vector<Quantity>& figures);
  /// Notes tables that were removed during the run, which goes on with new ones.
  void note_losses(Notes& notes) const;
  /// `equations`: the names of all that have a column.
  void write_iteration(const IterationRecord& record, const std::vector<std::string>& equations);
  /// Writes the state by all outputs.
  void write_frame(double time, int step, const Model& model, const std::vector<OutputField>& fields);
  Rows rows() const;  ///< of the tables now; 0 on processes other than the first
  /// `rows`: those of the tables at the state of the checkpoint.
  void write_checkpoint(const Model& model, const Notes& notes, const Rows& rows, std::map<std::string, Vector> extra,
                        const std::string& fingerprint);

  void write_record(const RunRecord& record, const Profile& profile) const;  ///< run.json

  std::filesystem::path path() const { return folder_.path(); }
  std::filesystem::path checkpoint_path() const { return path() / "checkpoint.h5"; }

 private:
  void start_writing(const std::optional<Continued>& from, const std::vector<FrameOutputChoice>& outputs);

  OutputFolder folder_;
  std::optional<RunLock> lock_;
  std::vector<TableWriter> tables_;                    ///< by Table; empty on all but the first process
  std::vector<std::unique_ptr<FrameOutput>> outputs_;  ///< empty on all but the first process
};

}  // namespace sprekk
