// Everything that a run writes into its folder. Does nothing on processes other than the first.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "framework/output/checkpoint.hpp"
#include "framework/output/field_output.hpp"
#include "framework/output/output_folder.hpp"
#include "framework/output/table_writer.hpp"
#include "framework/scene/model.hpp"
#include "framework/schedule/schedule_step.hpp"

namespace sprekk {

class RunOutput {
 public:
  explicit RunOutput(OutputFolder folder) : folder_(std::move(folder)) {}

  /// Creates the folder, or continues what is in it after `continue_from` (s).
  void open(const std::optional<double>& continue_from, bool with_fields);
  void write_history(const StepTime& step, int iterations, const std::vector<Quantity>& quantities);
  void write_iteration(const IterationRecord& record);
  void write_fields(double time, int step, const Mesh& mesh, const std::vector<OutputField>& fields);
  void write_checkpoint(const Model& model, const Checkpoint::Clock& clock, const Notes& notes,
                        const std::string& fingerprint);

  std::filesystem::path path() const { return folder_.path(); }
  std::filesystem::path checkpoint_path() const { return path() / "checkpoint.h5"; }

 private:
  OutputFolder folder_;
  std::optional<TableWriter> history_, coupling_;
  std::optional<FieldOutput> fields_;
};

}  // namespace sprekk
