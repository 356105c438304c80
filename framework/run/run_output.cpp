#include "framework/run/run_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <exception>
#include <limits>
#include <utility>

#include "framework/config/input_error.hpp"
#include "framework/output/build_info.hpp"
#include "framework/output/vtu_writer.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/run/note_records.hpp"

namespace sprekk {

namespace {

const std::string rows_of_tables = "rows of tables";  // in a checkpoint: of table_files
constexpr std::array<const char*, 3> table_files = {"history.csv", "coupling.csv",
                                                    "events.csv"};  // by RunOutput::Table

/// Does the work, on files, on the first process only. If it throws, all processes throw. Collective.
template <class Work>
void on_first_process(const Work& work) {
  std::exception_ptr failure;
  if (parallel::is_root()) {
    try {
      work();
    } catch (...) {
      failure = std::current_exception();
    }
  }
  const bool has_failed = parallel::any(failure != nullptr);
  if (failure) std::rethrow_exception(failure);
  if (has_failed) throw InputError("the first process could not open the output folder");
}

void require_unused(const std::filesystem::path& folder) {
  if (OutputFolder::holds_results(folder))
    throw InputError("the output folder " + folder.string() +
                     " is not empty any more (another run was faster) choose another one with -o");
}

}  // namespace

RunOutput::Continued RunOutput::continued(const Checkpoint& checkpoint, double time) {
  Continued from{time, std::nullopt};
  const auto rows = checkpoint.extra.find(rows_of_tables);
  if (rows == checkpoint.extra.end() || rows->second.size() != std::ssize(Rows{})) return from;
  from.rows.emplace();
  std::ranges::transform(rows->second, from.rows->begin(), [](double count) { return static_cast<long>(count); });
  return from;
}

void RunOutput::lock() {
  on_first_process([this] { lock_.emplace(folder_.path()); });
}

void RunOutput::open(const std::optional<Continued>& from, const std::vector<FrameOutputChoice>& outputs) {
  on_first_process([&] { start_writing(from, outputs); });
}

void RunOutput::start_writing(const std::optional<Continued>& from, const std::vector<FrameOutputChoice>& outputs) {
  const std::filesystem::path folder = folder_.create();
  if (!lock_) lock_.emplace(folder);
  if (!from) require_unused(folder);
  for (std::size_t i = 0; i < table_files.size(); ++i) {
    const std::filesystem::path file = folder / table_files[i];
    const auto rows = from && from->rows ? std::optional((*from->rows)[i]) : std::nullopt;
    tables_.push_back(from ? TableWriter::continued(file, from->time, rows) : TableWriter(file));
  }
  // Before its first step a run has written no more than the start, which it writes again.
  const bool goes_on = from && (!from->rows || (*from->rows)[history] > 0);
  const OutputPlace place{folder, goes_on ? std::optional(from->time) : std::nullopt};
  for (const FrameOutputChoice& output : outputs) outputs_.push_back(output.build(place));
}

void RunOutput::write_history(const StepTime& step, int iterations, const std::vector<Quantity>& quantities) {
  if (!parallel::is_root()) return;
  TableWriter::Row row{{"step[s]", step.dt}, {"iterations[1]", static_cast<double>(iterations)}};
  for (const Quantity& quantity : quantities) row.emplace_back(labelled(quantity.name, quantity.unit), quantity.value);
  tables_[history].append(step.end, row);
}

void RunOutput::write_events(const StepTime& step, const std::vector<Event>& events,
                             const std::vector<Quantity>& figures) {
  if (!parallel::is_root()) return;
  for (const Event& event : events) {
    TableWriter::Row row{{"kind", event.kind},
                         {"thing", event.thing},
                         {"begin[s]", event.begin},
                         {"duration[s]", event.end - event.begin}};
    for (int i = 0; i < dimension; ++i) row.emplace_back(labelled(std::string(1, "xyz"[i]), "m"), event.place[i]);
    for (const Quantity& known : figures) {
      const auto found = std::ranges::find(event.figures, known.name, &Quantity::name);
      row.emplace_back(labelled(known.name, known.unit),
                       found == event.figures.end() ? std::numeric_limits<double>::quiet_NaN() : found->value);
    }
    row.emplace_back("reason", event.reason);
    tables_[RunOutput::events].append(step.end, row);
  }
}

void RunOutput::note_losses(Notes& notes) const {
  const auto note = [&](const std::string& loss) {
    if (!loss.empty()) notes.add(loss.substr(0, loss.find(',')), loss);
  };
  for (const TableWriter& table : tables_) note(table.loss());
  for (const auto& output : outputs_) note(output->loss());
}

void RunOutput::write_iteration(const IterationRecord& record, const std::vector<std::string>& equations) {
  if (tables_.empty()) return;
  TableWriter::Row row = {{"step[s]", record.time.dt},
                          {"schedule", record.step},
                          {"iteration[1]", static_cast<double>(record.iteration)},
                          {"residual[1]", record.residual},
                          {"equation", record.equation},
                          {"update[1]", record.update},
                          {"step_length[1]", record.step_length},
                          {"pass[1]", static_cast<double>(record.pass)}};
  for (const std::string& name : equations) {
    const auto found = std::ranges::find(record.residuals, name, &std::pair<std::string, double>::first);
    const bool is_solved = found != record.residuals.end();
    row.emplace_back("residual." + name + "[1]", is_solved ? fmt::format("{:.3g}", found->second) : std::string());
  }
  // A table that an older version has begun has fewer columns.
  const std::vector<std::string>& known = tables_[coupling].columns();
  if (!known.empty())
    std::erase_if(row, [&](const auto& entry) { return std::ranges::count(known, entry.first) == 0; });
  tables_[coupling].append(record.time.end, row);
}

void RunOutput::write_frame(double time, int step, const Model& model, const std::vector<OutputField>& fields) {
  if (!parallel::is_root()) return;
  std::vector<OutputLine> lines;
  for (PendingPath& path : model.pending_paths()) lines.push_back({path.fracture, std::move(path.points)});
  const Frame frame{time, step, model.mesh(), fields, lines};
  for (const auto& output : outputs_) output->write(frame);
}

RunOutput::Rows RunOutput::rows() const {
  Rows rows{};
  for (std::size_t i = 0; i < tables_.size(); ++i) rows[i] = tables_[i].rows();
  return rows;
}

void RunOutput::write_checkpoint(const Model& model, const Notes& notes, const Rows& rows,
                                 std::map<std::string, Vector> extra, const std::string& fingerprint) {
  if (!parallel::is_root()) return;
  Checkpoint checkpoint;
  checkpoint.scene_name = model.scene().name;
  checkpoint.scene_fingerprint = fingerprint;
  checkpoint.program_version = build_info().version;
  checkpoint.notes = records_of(notes);
  checkpoint.mesh = model.mesh();
  checkpoint.fields = field_values(model.fields());
  checkpoint.extra = std::move(extra);
  Vector& counts = checkpoint.extra[rows_of_tables];
  counts.resize(std::ssize(rows));
  std::ranges::copy(rows, counts.begin());
  sprekk::write_checkpoint(checkpoint_path(), checkpoint);
}

void RunOutput::write_record(const RunRecord& record, const Profile& profile) const {
  if (parallel::is_root()) record.write(path() / "run.json", profile);
}

}  // namespace sprekk
