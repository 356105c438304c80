#include "framework/run/simulation.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <iterator>

#include "framework/linear/direct/blas_memory.hpp"
#include "framework/output/activity.hpp"
#include "framework/output/progress.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/run/checkpoints.hpp"
#include "framework/run/early_end.hpp"
#include "framework/run/effort.hpp"
#include "framework/run/end_report.hpp"
#include "framework/run/interrupt.hpp"
#include "framework/run/mesh_growth.hpp"
#include "framework/run/output_times.hpp"
#include "framework/run/restart.hpp"
#include "framework/run/run_output.hpp"
#include "framework/run/run_recorder.hpp"
#include "framework/run/scene_fingerprint.hpp"
#include "framework/run/simulation_state.hpp"
#include "framework/run/step_attempts.hpp"
#include "framework/scene/programs.hpp"
#include "framework/scene/start_state.hpp"

namespace sprekk {

namespace {

OutputFolder choose_folder(const Scene& scene, const RunOptions& options) {
  if (options.checkpoint) {
    const std::filesystem::path folder = options.checkpoint->parent_path();
    return OutputFolder::given(folder.empty() ? "." : folder, OutputFolder::Purpose::restart);
  }
  if (options.folder) return OutputFolder::given(*options.folder);
  return OutputFolder::for_scene(scene.name);
}

std::optional<Restart> read_if_given(const Scene& scene, const RunOptions& options, RunOutput& output) {
  return options.checkpoint ? std::optional<Restart>(std::in_place, scene, *options.checkpoint, output) : std::nullopt;
}

/// A run that goes on has the mesh of its checkpoint.
std::unique_ptr<Model> make_model(const Scene& scene, const std::optional<Restart>& restart, IterationLog log,
                                  Progress& progress) {
  progress.watch();
  progress.phase("building the model");
  const auto built = [](std::unique_ptr<Model> model) {
    require_programs(model->parts());
    return model;
  };
  if (restart) return built(std::make_unique<Model>(scene, restart->mesh(scene.mesh.division), std::move(log)));
  auto model = built(std::make_unique<Model>(scene, std::move(log)));
  take_start(*model);
  model->require_held();
  return model;
}

/// Steps end at output times and where data jump.
SimulationState first_state(const Scene& scene, std::unique_ptr<Model> model, const OutputTimes& output_times) {
  std::vector<double> targets = model->switch_times();
  targets.insert(targets.end(), output_times.all().begin(), output_times.all().end());
  SplittingError splitting_error(*model);
  return {std::move(model), StepController(scene.time, std::move(targets)), {}, std::move(splitting_error)};
}

/// One run, from its first step to its end or to a failure.
class Simulation {
 public:
  Simulation(const Scene& scene, const RunOptions& options);
  ExitCode run();

 private:
  IterationLog log();
  void write_start();
  ExitCode step_to_the_end(const InterruptGuard& interrupt, Checkpoints& checkpoints);
  void accept(const StepTime& step, const StepStatus& status);
  bool follow_growth();  ///< false when the mesh could not
  void finish(ExitCode code);
  void fail(const std::string& reason);

  const RunOptions& options_;
  RunRecorder recorder_;
  Progress progress_;
  ActivityListener activities_{[this](const std::string& what) { progress_.part(what); }};
  RunOutput output_;
  bool writes_frames_ = false;  ///< whether the scene has an output
  OutputTimes output_times_;
  std::optional<Restart> restart_;  ///< until it has been taken over
  std::optional<RunOutput::Continued> continued_;
  SimulationState state_;
  EarlyEnd early_end_;
  Profile profile_;
  Effort effort_;
  MeshGrowth growth_;
  StepAttempts attempts_;
  std::string reason_;  ///< why the run has not come to its end
};

Simulation::Simulation(const Scene& scene, const RunOptions& options)
    : options_(options),
      recorder_(options.scene_files),
      progress_(Progress::style_for(STDERR_FILENO, parallel::is_root(), options.quiet), std::cerr, scene.time.start,
                scene.time.end),
      output_(choose_folder(scene, options)),
      output_times_(scene),
      restart_(read_if_given(scene, options, output_)),
      state_(first_state(scene, make_model(scene, restart_, log(), progress_), output_times_)),
      early_end_(scene, state_.model->quantities()),
      growth_(state_.model, state_.controller, log(),
              [this](const Model& model, const Model* settled) { effort_.retired(model, settled); }),
      attempts_(state_, growth_, effort_, profile_, progress_) {
  recorder_.set_up_ends();
  if (!restart_) return;
  restart_->restore(state_);
  continued_ = restart_->continued(state_);
  restart_.reset();
  std::vector<Quantity> columns = state_.model->quantities();
  std::ranges::copy(state_.splitting_error.quantities(), std::back_inserter(columns));
  require_columns(columns, output_);
}

IterationLog Simulation::log() {
  return [this](const IterationRecord& record) {
    std::vector<std::string> equations;
    for (const auto& field : state_.model->fields().all())
      if (field->is_solved()) equations.push_back(field->name());
    output_.write_iteration(record, equations);
    progress_.part(fmt::format("{}, iteration {}, residual {:.1e} of {}", record.step, record.iteration,
                               record.residual, record.equation),
                   true);
  };
}

/// Writes the outputs at the start of a run, also where it was killed before its first step had ended.
void Simulation::write_start() {
  Model& model = *state_.model;
  if (state_.controller.steps() > 0 || !writes_frames_) return;
  try {
    model.prepare(state_.controller.next());  // what the first step does first, and does not repeat
  } catch (const DataError&) {
    return;  // the first step says so
  }
  const ScopedTimer timer(profile_, "output");
  output_.write_frame(state_.controller.time(), 0, model, model.output());
}

ExitCode Simulation::step_to_the_end(const InterruptGuard& interrupt, Checkpoints& checkpoints) {
  const StepController& controller = state_.controller;
  while (!controller.is_finished() && !early_end_.is_reached()) {
    checkpoints.step_begins();
    const StepAttempts::Outcome outcome = attempts_.run();
    if (outcome != StepAttempts::Outcome::converged) reason_ = attempts_.reason();
    if (outcome == StepAttempts::Outcome::interrupted) {
      checkpoints.write_begin_of_step();
      return ExitCode::interrupted;
    }
    if (outcome == StepAttempts::Outcome::failed) {
      checkpoints.write();
      return ExitCode::failed;
    }
    accept(attempts_.step(), attempts_.status());
    if (!follow_growth()) {
      checkpoints.write();
      return ExitCode::failed;
    }
    progress_.reached(controller.time(), controller.steps());
    if (interrupt.is_interrupted() && !controller.is_finished()) {
      reason_ = "interrupted";
      checkpoints.write();
      return ExitCode::interrupted;
    }
    checkpoints.write_if_due();
  }
  if (early_end_.is_reached()) progress_.stopped(controller.time(), controller.steps(), early_end_.text());
  checkpoints.write();
  return ExitCode::done;
}

void Simulation::accept(const StepTime& step, const StepStatus& status) {
  Model& model = *state_.model;
  // Evaluated before the step is accepted: slip, for example, is told from changes since the last accepted step.
  std::vector<Quantity> quantities = model.quantities();
  state_.notes.at_time(step.end);
  for (const Part* part : model.parts()) part->note_step(state_.notes, step);
  model.schedule().note_step(state_.notes, step);
  std::vector<Event> events;
  std::vector<Quantity> event_figures;
  for (const TellsEvents* part : parts_with<TellsEvents>(model.parts())) {
    std::ranges::move(part->events(step), std::back_inserter(events));
    for (const Quantity& figure : part->event_figures())
      if (std::ranges::find(event_figures, figure.name, &Quantity::name) == event_figures.end())
        event_figures.push_back(figure);
  }
  state_.balance.note_step(model.balances(), model.schedule().largest_imbalance(), state_.notes);
  early_end_.check(model, step, quantities);
  const bool writes_frame = writes_frames_ && (early_end_.is_reached() || output_times_.contains(step.end));
  const std::vector<OutputField> fields = writes_frame ? model.output() : std::vector<OutputField>();
  recorder_.note_topology(model, step.end);
  SplittingError& splitting_error = state_.splitting_error;
  splitting_error.observe(growth_.changes());
  splitting_error.before_acceptance(model, step);
  model.accept();
  if (splitting_error.is_due()) {
    const ScopedTimer timer(profile_, "steps");
    splitting_error.after_acceptance(model, step);
  }
  splitting_error.note_step(state_.notes);
  std::ranges::copy(splitting_error.quantities(), std::back_inserter(quantities));
  state_.controller.accepted(step, status.effort());
  recorder_.accepted(quantities);
  recorder_.note_splitting_errors(splitting_error.of_fields());
  const ScopedTimer timer(profile_, "output");
  output_.write_history(step, status.iterations, quantities);
  output_.write_events(step, events, event_figures);
  output_.note_losses(state_.notes);
  if (writes_frame) output_.write_frame(step.end, state_.controller.steps(), model, fields);
}

bool Simulation::follow_growth() {
  progress_.phase("letting the mesh follow");
  const ScopedTimer timer(profile_, "change of mesh");
  const MeshGrowth::Outcome outcome = growth_.after_acceptance();
  state_.splitting_error.observe(growth_.changes());
  if (outcome != MeshGrowth::Outcome::failed) return true;
  reason_ = growth_.reason();
  return false;
}

void Simulation::finish(ExitCode code) {
  recorder_.end(code, reason_, state_.model->scene(), early_end_);
  recorder_.add(growth_);
  effort_.finish(*state_.model, recorder_.record(), profile_);
  if (const long events = output_.rows()[RunOutput::events]; events > 0) recorder_.record().counters["events"] = events;
  recorder_.close(state_.notes, profile_);
  output_.write_record(recorder_.record(), profile_);
  report_end(recorder_.record(), profile_, state_, output_, options_.quiet);
}

/// For a run whose results cannot be written any more: its last checkpoint stays, with the row counts of the tables.
void Simulation::fail(const std::string& reason) {
  recorder_.fail(reason);
  try {
    output_.write_record(recorder_.record(), profile_);
  } catch (const std::exception&) {
    // The exception that led here is reported by its own handler.
  }
  report_last_checkpoint(output_);
}

ExitCode Simulation::run() {
  reserve_blas_memory();
  recorder_.begin(*state_.model);
  const InterruptGuard interrupt;
  const std::vector<FrameOutputChoice> outputs = state_.model->scene().output.chosen_outputs();
  writes_frames_ = !outputs.empty();
  output_.open(continued_, outputs);
  Checkpoints checkpoints(state_, output_, scene_fingerprint(state_.model->scene()));
  if (!continued_) checkpoints.write();  // before anything else, so that a run that is killed can always go on
  output_.write_record(recorder_.record(), profile_);
  for (const NoteRecord& note : recorder_.record().notes) progress_.event("note: " + described(note));
  ExitCode code = ExitCode::failed;
  try {
    write_start();
    code = step_to_the_end(interrupt, checkpoints);
  } catch (const std::exception& error) {
    progress_.close();
    fail(error.what());
    throw;
  }
  progress_.close();
  finish(code);
  return code;
}

}  // namespace

ExitCode run_scene(const Scene& scene, const RunOptions& options) { return Simulation(scene, options).run(); }

}  // namespace sprekk
