#include "framework/run/run_recorder.hpp"

#include <fmt/format.h>

#include <ctime>

#include "framework/linear/direct/blas_memory.hpp"
#include "framework/mesh/quality/mesh_quality.hpp"
#include "framework/mesh/topology_hash.hpp"
#include "framework/output/progress.hpp"
#include "framework/output/vtu_writer.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/plugin/plugin.hpp"
#include "framework/run/note_records.hpp"
#include "framework/run/recorded_parameters.hpp"
#include "framework/run/start_notes.hpp"

namespace sprekk {

namespace {

double processor_now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

RunRecorder::RunRecorder(std::vector<std::string> scene_files) : processor_at_start_(processor_now()) {
  record_.scene_files = std::move(scene_files);
}

void RunRecorder::set_up_ends() {
  processor_after_set_up_ = processor_now();
  began_ = Progress::steady_seconds();
}

void RunRecorder::begin(const Model& model) {
  record_.scene_name = model.scene().name;
  record_.parameters = recorded_parameters(model.scene());
  for (const Fracture& fracture : model.mesh().fractures) record_.fractures.push_back(fracture.name);
  for (const Plugin& plugin : loaded_plugins()) record_.plugins.push_back({plugin.file.string(), plugin.types});
  record_.blas = blas_in_use().name;
  record_.processes = parallel::size();
  const MeshQuality quality = mesh_quality(model.mesh());
  record_.counters["mesh: cells"] = quality.cells;
  record_.counters["mesh: fracture cells"] = quality.fracture_cells;
  record_.results["mesh_smallest_angle[rad]"] = quality.smallest_angle;
  record_.counters["objects: components"] = static_cast<long>(model.components().size());
  record_.counters["objects: couplers"] = static_cast<long>(model.couplers().size());
  record_.counters["objects: fields"] = static_cast<long>(model.fields().all().size());
  long unknowns = 0;
  for (const Field* field : model.schedule().unknowns()) {
    unknowns += field->size();
    record_.counters["unknowns: " + field->name()] = field->size();
  }
  record_.counters["unknowns"] = unknowns;
  start_notes_ = start_notes(model, quality, unknowns);
  record_.notes = records_of(start_notes_);
}

void RunRecorder::accepted(const std::vector<Quantity>& quantities) {
  ++steps_;
  for (const Quantity& q : quantities) record_.results[labelled(q.name, q.unit)] = q.value;
  last_quantities_ = quantities;
}

void RunRecorder::note_splitting_errors(const std::map<std::string, double>& errors) {
  for (const auto& [field, error] : errors) record_.results["splitting_error of " + field + "[1]"] = error;
}

void RunRecorder::note_topology(const Model& model, double time) {
  TopologyHash hash;
  hash.add(topology_hash(model.mesh()));
  for (const auto& grow : model.growing()) hash.add(grow->component().topology());
  std::string digits = fmt::format("{:016x}", hash.value());
  if (record_.topologies.empty() || record_.topologies.back().hash != digits)
    record_.topologies.push_back({time, std::move(digits)});
}

void RunRecorder::end(ExitCode code, const std::string& reason, const Scene& scene, const EarlyEnd& early) {
  record_.exit_code = static_cast<int>(code);
  record_.exit_reason = code != ExitCode::done ? reason : early.has_stopped() ? "stopped: " + early.text() : "done";
  if (early.steady_since()) record_.results["steady_since[s]"] = *early.steady_since();
  if (code == ExitCode::done && scene.time.has_stop && !early.is_reached())
    start_notes_.add("time.stop not reached", "time.stop was not reached: the run went on to time.end (" +
                                                  early.missed_text(last_quantities_) + ")");
  if (early.has_stopped() && steps_ == 1 && !early.reached_at_start().empty())
    start_notes_.add("time.stop in the first step",
                     "time.stop ended the run with its first step: " + early.text() + " (" + early.reached_at_start() +
                         ": 'reaches' ends a run at this value and all larger ones, 'falls_to' at all smaller ones) "
                         "take the other one, if the quantity is to pass the value");
  record_.seconds = Progress::steady_seconds() - began_;
  record_.timings["processor: set-up"] = processor_after_set_up_ - processor_at_start_;
  record_.timings["processor: steps and output"] = processor_now() - processor_after_set_up_;
  record_.counters["steps accepted"] = steps_;
}

void RunRecorder::add(const MeshGrowth& growth) {
  if (growth.held() > 0) record_.counters["steps with growth held"] = growth.held();
  if (growth.changes() == 0) return;
  record_.counters["changes of the mesh"] = growth.changes();
  if (growth.trials() > 0) record_.counters["trials of growth"] = growth.trials();
  record_.results["grown_cells_smallest_angle[rad]"] = growth.smallest_angle();
}

void RunRecorder::close(const Notes& step_notes, const Profile& profile) {
  record_.timings["factorizations, back-solves"] = profile.solver_seconds();
  record_.timings["everything else"] = record_.seconds - profile.solver_seconds();
  record_.notes = records_of(start_notes_);
  for (NoteRecord& note : records_of(step_notes)) record_.notes.push_back(std::move(note));
}

void RunRecorder::fail(const std::string& reason) {
  record_.exit_code = static_cast<int>(ExitCode::failed);
  record_.exit_reason = reason;
  record_.seconds = Progress::steady_seconds() - began_;
}

}  // namespace sprekk
