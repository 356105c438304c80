#include "framework/run/restart.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/mesh/partition.hpp"
#include "framework/output/parameter_difference.hpp"
#include "framework/output/table_writer.hpp"
#include "framework/output/vtu_writer.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/run/note_records.hpp"
#include "framework/run/recorded_parameters.hpp"
#include "framework/run/scene_fingerprint.hpp"

namespace sprekk {

namespace {

/// What may be said to have changed when the fingerprint of the scene has.
std::string change_of(const Scene& scene, const std::filesystem::path& checkpoint) {
  const std::string parameter = parameter_difference(checkpoint.parent_path() / "run.json", recorded_parameters(scene));
  const std::vector<std::string> files = files_of(scene);
  if (!parameter.empty() || files.empty()) return parameter;
  return fmt::format("no parameter has, but the content of {}{}", files.size() > 1 ? "one of " : "", listed(files));
}

}  // namespace

Restart::Restart(const Scene& scene, const std::filesystem::path& file, RunOutput& output) : file_(file) {
  // A missing file is reported by its reader below, not as a folder that cannot be locked.
  if (std::error_code error; std::filesystem::exists(file, error)) output.lock();
  checkpoint_ = read_checkpoint(file);
  require_scene(checkpoint_, file, scene.name, scene_fingerprint(scene), change_of(scene, file));
}

Mesh Restart::mesh(Division division) const {
  Mesh mesh = checkpoint_.mesh;
  partition(mesh, parallel::size(), division);
  return mesh;
}

void Restart::restore(SimulationState& state) const {
  restore_fields(checkpoint_, file_, state.model->fields());
  state.model->restore_extra_state(checkpoint_.extra);
  state.controller.restore(checkpoint_.extra);
  state.notes.restore(notes_of(checkpoint_.notes));
  state.balance.restore(checkpoint_.extra);
  state.splitting_error.restore(*state.model, checkpoint_.extra);
}

RunOutput::Continued Restart::continued(const SimulationState& restored) const {
  return RunOutput::continued(checkpoint_, restored.controller.time());
}

void require_columns(const std::vector<Quantity>& quantities, const RunOutput& output) {
  const std::vector<std::string> columns = TableWriter::columns_of(output.path() / "history.csv");
  if (columns.empty()) return;
  for (const Quantity& quantity : quantities) {
    const std::string column = labelled(quantity.name, quantity.unit);
    if (std::find(columns.begin(), columns.end(), column) == columns.end())
      throw InputError(
          "history.csv of the run that is to go on has no column " + column +
          " (a probe that it did not have) restart with the probes it had, or start the scene anew with -o");
  }
}

}  // namespace sprekk
