#include "framework/scene/run_output.hpp"

#include "framework/output/build_info.hpp"
#include "framework/output/vtu_writer.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {

void RunOutput::open(const std::optional<double>& continue_from, bool with_fields) {
  if (!parallel::is_root()) return;
  const std::filesystem::path folder = folder_.create();
  if (continue_from) {
    history_ = TableWriter::continued(folder / "history.csv", *continue_from);
    coupling_ = TableWriter::continued(folder / "coupling.csv", *continue_from);
    if (with_fields) fields_ = FieldOutput::continued(folder, *continue_from);
  } else {
    history_.emplace(folder / "history.csv");
    coupling_.emplace(folder / "coupling.csv");
    if (with_fields) fields_.emplace(folder);
  }
}

void RunOutput::write_history(const StepTime& step, int iterations, const std::vector<Quantity>& quantities) {
  if (!parallel::is_root()) return;
  TableWriter::Row row{{"step[s]", step.dt}, {"iterations[1]", static_cast<double>(iterations)}};
  for (const Quantity& quantity : quantities) row.emplace_back(labelled(quantity.name, quantity.unit), quantity.value);
  history_->append(step.end, row);
}

void RunOutput::write_iteration(const IterationRecord& record) {
  if (!parallel::is_root() || !coupling_) return;
  coupling_->append(record.time.end, {{"step[s]", record.time.dt},
                                      {"schedule", record.step},
                                      {"iteration[1]", static_cast<double>(record.iteration)},
                                      {"residual[1]", record.residual},
                                      {"equation", record.equation},
                                      {"update[1]", record.update},
                                      {"step_length[1]", record.step_length}});
}

void RunOutput::write_fields(double time, int step, const Mesh& mesh, const std::vector<OutputField>& fields) {
  if (parallel::is_root() && fields_) fields_->write(time, step, mesh, fields);
}

void RunOutput::write_checkpoint(const Model& model, const Checkpoint::Clock& clock, const Notes& notes,
                                 const std::string& fingerprint) {
  if (!parallel::is_root()) return;
  Checkpoint checkpoint;
  checkpoint.scene_name = model.scene().name;
  checkpoint.scene_fingerprint = fingerprint;
  checkpoint.program_version = build_info().version;
  checkpoint.clock = clock;
  checkpoint.notes = notes.all();
  checkpoint.mesh = model.mesh();
  checkpoint.fields = field_values(model.fields());
  checkpoint.extra = model.extra_state();
  sprekk::write_checkpoint(checkpoint_path(), checkpoint);
}

}  // namespace sprekk
