// Everything that a run writes into its folder. Does nothing on processes other than the first.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "framework/output/checkpoint.hpp"
#include "framework/output/field_output.hpp"
#include "framework/output/output_folder.hpp"
#include "framework/output/run_lock.hpp"
#include "framework/output/run_record.hpp"
#include "framework/output/table_writer.hpp"
#include "framework/scene/model.hpp"
#include "framework/schedule/schedule_step.hpp"

namespace sprekk {

class RunOutput {
 public:
  explicit RunOutput(OutputFolder folder) : folder_(std::move(folder)) {}

  /// A run that goes on: lets no other run into its folder from now on. Throws InputError when one is there.
  /// Collective.
  void lock();
  /// What the tables of a run that goes on were when its checkpoint was written.
  struct Rows {
    long history, coupling;
  };
  struct Continued {
    double time;               ///< s
    std::optional<Rows> rows;  ///< checkpoints of old have none
  };
  static Continued continued(const Checkpoint& checkpoint, double time);

  /// Creates the folder and locks it, or continues what is in it. Throws InputError when another run is at work there
  /// or when a table is missing. Collective.
  void open(const std::optional<Continued>& from, bool with_fields);
  void write_history(const StepTime& step, int iterations, const std::vector<Quantity>& quantities);
  void write_iteration(const IterationRecord& record);
  void write_fields(double time, int step, const Mesh& mesh, const std::vector<OutputField>& fields);
  Rows rows() const;  ///< of the tables as they are; 0 on processes other than the first
  /// `rows`: what the tables had when the state was the one of the checkpoint.
  void write_checkpoint(const Model& model, const Notes& notes, const Rows& rows, std::map<std::string, Vector> extra,
                        const std::string& fingerprint);

  void write_record(const RunRecord& record, const Profile& profile) const;  ///< run.json

  std::filesystem::path path() const { return folder_.path(); }
  std::filesystem::path checkpoint_path() const { return path() / "checkpoint.h5"; }

 private:
  void start_writing(const std::optional<Continued>& from, bool with_fields);

  OutputFolder folder_;
  std::optional<RunLock> lock_;
  std::optional<TableWriter> history_, coupling_;
  std::optional<FieldOutput> fields_;
};

}  // namespace sprekk
