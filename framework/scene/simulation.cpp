#include "framework/scene/simulation.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iostream>
#include <numbers>

#include "framework/config/units.hpp"
#include "framework/linear/blas_memory.hpp"
#include "framework/mesh/mesh_quality.hpp"
#include "framework/mesh/partition.hpp"
#include "framework/output/activity.hpp"
#include "framework/output/checkpoint.hpp"
#include "framework/output/parameter_difference.hpp"
#include "framework/output/progress.hpp"
#include "framework/output/vtu_writer.hpp"
#include "framework/parallel/interruption.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/scene/books.hpp"
#include "framework/scene/checkpoint_interval.hpp"
#include "framework/scene/interrupt.hpp"
#include "framework/scene/mesh_growth.hpp"
#include "framework/scene/note_records.hpp"
#include "framework/scene/run_output.hpp"
#include "framework/scene/stop_condition.hpp"
#include "framework/schedule/relative_change.hpp"

namespace sprekk {

namespace {

/// Degrees; what tools/stress has found to be harmless.
constexpr double least_good_angle = 5;

double now() { return Progress::steady_seconds(); }
double processor_now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::vector<double> output_times(const Scene& scene) {
  std::vector<double> times = scene.output.times;
  if (scene.output.every)
    for (long i = 1; scene.time.start + i * *scene.output.every < scene.time.end * (1 + 1e-12); ++i)
      times.push_back(scene.time.start + i * *scene.output.every);
  times.push_back(scene.time.end);
  return times;
}

/// The step controller takes targets nearer than `tolerance` (s) for one.
bool contains(const std::vector<double>& times, double time, double tolerance) {
  for (const double other : times)
    if (std::abs(other - time) <= tolerance) return true;
  return false;
}

/// The tree as text in which neither comments nor the order of reading matter.
void append_text(const Node& node, std::string& text) {
  text += node.scalar;
  for (const Node& item : node.items) append_text(item, text += "[");
  for (const Node::Entry& entry : node.entries) {
    if (node.path.empty() && (entry.key == "output" || entry.key == "name")) continue;
    if (node.path == "time" && entry.key == "end") continue;
    append_text(entry.value, text += "{" + entry.key + ":");
  }
  text += ";";
}

/// One run from its first step to its end, however it ends.
class Run {
 public:
  Run(const Scene& scene, const RunOptions& options);
  ExitCode execute();

 private:
  IterationLog log() {
    return [this](const IterationRecord& record) {
      output_.write_iteration(record);
      progress_.part(fmt::format("{}, iteration {}, residual {:.1e} of {}", record.step, record.iteration,
                                 record.residual, record.equation),
                     true);
    };
  }
  void restore();
  void require_columns() const;
  void record_start();
  void note_input(const MeshQuality& quality, long unknowns);
  void note_step(const StepTime& step);    ///< that is about to be accepted
  void retire_counts(const Model& model);  ///< adds what the model has counted to the totals
  void split_steps();                      ///< takes what others have timed inside of steps out of their time
  void count_settling();
  bool follows_growth();  ///< false when the mesh could not
  bool fails_with_growth();
  bool stays_as_it_is(const StepTime& step) const;  ///< of the state that is about to be accepted
  ExitCode loop(const InterruptGuard& interrupt);
  bool advance();  ///< one accepted step; false with reason_ when none is possible
  void finish(ExitCode code);
  void record_failure(const std::string& reason);

  const RunOptions& options_;
  const double processor_at_start_ = processor_now();
  Progress progress_;
  ActivityListener activities_{[this](const std::string& what) { progress_.part(what); }};
  RunOutput output_;
  std::optional<Checkpoint> checkpoint_;  ///< that the run goes on from, until it has been taken over
  std::optional<RunOutput::Continued> continued_;
  std::unique_ptr<Model> model_;
  StopCondition stop_;
  std::vector<double> output_times_;
  StepController controller_;
  MeshGrowth growth_;
  Profile profile_;
  RunRecord record_;
  Notes input_notes_, step_notes_;
  Books books_;
  std::vector<Quantity> last_quantities_;
  std::string fingerprint_, reason_;
  std::string ends_early_;  ///< why the run is done before its end
  double began_, processor_at_first_step_;
  long newton_iterations_ = 0, rejected_ = 0;
  int restored_steps_ = 0;
  bool is_stopped_ = false;
  bool is_interrupted_ = false;  ///< within a step, which has been rewound
  LinearCounts linear_counts_;
  double settling_seconds_ = 0;  ///< of linear solvers during changes of the mesh
  Profile efforts_;              ///< of parts that are timed inside of steps
};

OutputFolder choose_folder(const Scene& scene, const RunOptions& options) {
  if (options.checkpoint) {
    const std::filesystem::path folder = options.checkpoint->parent_path();
    return OutputFolder::given(folder.empty() ? "." : folder, OutputFolder::Purpose::restart);
  }
  if (options.folder) return OutputFolder::given(*options.folder);
  return OutputFolder::for_scene(scene.name);
}

std::vector<double> targets(const std::vector<double>& outputs, std::vector<double> switches) {
  switches.insert(switches.end(), outputs.begin(), outputs.end());
  return switches;
}

/// A run that goes on has the mesh of its checkpoint, which may have grown.
std::unique_ptr<Model> make_model(const Scene& scene, const std::optional<Checkpoint>& checkpoint, IterationLog log,
                                  Progress& progress) {
  progress.watch();
  progress.phase("building the model");
  if (!checkpoint) return std::make_unique<Model>(scene, std::move(log));
  Mesh mesh = checkpoint->mesh;
  partition(mesh, parallel::size());
  return std::make_unique<Model>(scene, std::move(mesh), std::move(log));
}

std::vector<RunRecord::Parameter> parameters_of(const Scene& scene) {
  std::vector<RunRecord::Parameter> parameters;
  for (const Scene::Resolved& r : scene.resolved) parameters.push_back({r.path, r.value, r.origin});
  return parameters;
}

std::optional<Checkpoint> read_if_given(const Scene& scene, const RunOptions& options, RunOutput& output) {
  if (!options.checkpoint) return std::nullopt;
  // A file that is missing is told by its reader, not as a folder that cannot be locked.
  if (std::error_code error; std::filesystem::exists(*options.checkpoint, error)) output.lock();
  Checkpoint checkpoint = read_checkpoint(*options.checkpoint);
  require_scene(checkpoint, *options.checkpoint, scene.name, scene_fingerprint(scene),
                parameter_difference(options.checkpoint->parent_path() / "run.json", parameters_of(scene)));
  return checkpoint;
}

Run::Run(const Scene& scene, const RunOptions& options)
    : options_(options),
      progress_(Progress::style_for(STDERR_FILENO, parallel::is_root(), options.quiet), std::cerr, scene.time.start,
                scene.time.end),
      output_(choose_folder(scene, options)),
      checkpoint_(read_if_given(scene, options, output_)),
      model_(make_model(scene, checkpoint_, log(), progress_)),
      stop_(scene, model_->quantities()),
      output_times_(output_times(scene)),
      controller_(scene.time, targets(output_times_, model_->switch_times())),
      growth_(model_, controller_, log(), [this](const Model& model) { retire_counts(model); }),
      fingerprint_(scene_fingerprint(scene)),
      began_(now()),
      processor_at_first_step_(processor_now()) {
  if (checkpoint_) {
    restore();
    require_columns();
  }
}

void Run::restore() {
  restore_fields(*checkpoint_, *options_.checkpoint, model_->fields());
  model_->restore_extra_state(checkpoint_->extra);
  controller_.restore(checkpoint_->extra);
  step_notes_.restore(notes_of(checkpoint_->notes));
  books_.restore(checkpoint_->extra);
  restored_steps_ = controller_.steps();
  continued_ = RunOutput::continued(*checkpoint_, controller_.time());
  checkpoint_.reset();
}

/// A run that goes on appends to its tables, whose columns are there.
void Run::require_columns() const {
  const std::vector<std::string> columns = TableWriter::columns_of(output_.path() / "history.csv");
  if (columns.empty()) return;
  for (const Quantity& quantity : model_->quantities()) {
    const std::string column = labelled(quantity.name, quantity.unit);
    if (std::find(columns.begin(), columns.end(), column) == columns.end())
      throw InputError(
          "history.csv of the run that is to go on has no column " + column +
          " (a probe that it did not have) restart with the probes it had, or start the scene anew with -o");
  }
}

void Run::note_input(const MeshQuality& quality, long unknowns) {
  input_notes_ = model_->input_notes();
  if (blas_in_use().is_reference)
    input_notes_.add("reference BLAS",
                     "the reference BLAS is in use, which makes sparse factorizations several times slower: "
                     "install libopenblas0-pthread");
  if (const double angle = quality.smallest_angle * 180 / std::numbers::pi; angle < least_good_angle)
    input_notes_.add(
        "small angle of the mesh",
        fmt::format("the mesh has an angle of {:.2g} degrees, where multi-point fluxes and stresses may overshoot "
                    "(lines that meet at a small angle, or a gap narrower than mesh.gap_size)",
                    angle));
  // Measured: with 44,000 unknowns in two dimensions each of two processes is as busy as one alone.
  constexpr long worth_sharing = 50'000;
  if (parallel::size() > 1 && unknowns < worth_sharing)
    input_notes_.add(
        "too few unknowns for several processes",
        fmt::format("the run shares {} unknowns among {} processes, which as a rule takes longer than one alone (below "
                    "about {} each is as busy as one would be, and waits for the others) start it without mpirun",
                    unknowns, parallel::size(), worth_sharing));
  record_.notes = records_of(input_notes_);
}

void Run::note_step(const StepTime& step) {
  step_notes_.at_time(step.end);
  for (const Part* part : model_->parts()) part->note_step(step_notes_, step);
  books_.note_step(model_->balances(), step_notes_);
}

void Run::record_start() {
  const Scene& scene = model_->scene();
  record_.scene_name = scene.name;
  record_.scene_files = options_.scene_files;
  record_.parameters = parameters_of(scene);
  record_.blas = blas_in_use().name;
  record_.processes = parallel::size();
  const MeshQuality quality = mesh_quality(model_->mesh());
  record_.counters["mesh: cells"] = quality.cells;
  record_.counters["mesh: fracture cells"] = quality.fracture_cells;
  record_.results["mesh_smallest_angle[rad]"] = quality.smallest_angle;
  record_.counters["objects: components"] = static_cast<long>(model_->components().size());
  record_.counters["objects: couplers"] = static_cast<long>(model_->couplers().size());
  record_.counters["objects: fields"] = static_cast<long>(model_->fields().all().size());
  long unknowns = 0;
  for (const Field* field : model_->schedule().unknowns()) {
    unknowns += field->size();
    record_.counters["unknowns: " + field->name()] = field->size();
  }
  record_.counters["unknowns"] = unknowns;
  note_input(quality, unknowns);
}

bool Run::stays_as_it_is(const StepTime& step) const {
  const TimeOptions& time = model_->scene().time;
  if (!time.stop_when_steady) return false;
  for (const double jump : model_->switch_times())
    if (jump > step.start && jump < time.end) return false;
  const double rest = std::max(1.0, (time.end - step.end) / step.dt);
  return rest * relative_change(model_->schedule().unknowns()) <= *time.stop_when_steady;
}

void Run::retire_counts(const Model& model) {
  model.schedule().add_counts(linear_counts_);
  for (const Part* part : model.parts()) {
    for (const auto& [name, count] : part->counts()) record_.counters[name] += count;
    for (const Profile::Entry& effort : part->efforts()) {
      Profile::Entry& entry = efforts_.at(effort.name);
      entry.calls += effort.calls;
      entry.reuses += effort.reuses;
      entry.skips += effort.skips;
      entry.seconds += effort.seconds;
      entry.is_solver = effort.is_solver;
    }
  }
}

/// The model of a mesh that has just changed has solved for nothing but its settling.
void Run::count_settling() {
  LinearCounts counts;
  model_->schedule().add_counts(counts);
  settling_seconds_ += counts.seconds();
}

bool Run::fails_with_growth() {
  reason_ = growth_.reason();
  return false;
}

bool Run::follows_growth() {
  progress_.phase("letting the mesh follow");
  const ScopedTimer timer(profile_, "change of mesh");
  const MeshGrowth::Outcome outcome = growth_.after_acceptance();
  if (outcome == MeshGrowth::Outcome::changed) count_settling();
  return outcome != MeshGrowth::Outcome::failed || fails_with_growth();
}

bool Run::advance() {
  // On a mesh that has grown within the step the attempt must come to its end: a restart would not know of the change.
  bool has_grown = false;
  for (;;) {
    const StepTime step = controller_.next();
    StepStatus status;
    progress_.phase(fmt::format("step {} from {} over {}", controller_.steps() + 1, duration_text(step.start),
                                duration_text(step.dt)));
    try {
      const ScopedTimer timer(profile_, "steps");
      std::optional<interruption::Allowed> may_be_interrupted;
      if (!has_grown) may_be_interrupted.emplace();
      status = model_->attempt(step);
    } catch (const DataError& error) {
      model_->rewind();
      reason_ = fmt::format("the step from {} over {} has no data: {}", duration_text(step.start),
                            duration_text(step.dt), error.what());
      return false;
    } catch (const Interrupted&) {
      model_->rewind();
      reason_ = "interrupted";
      is_interrupted_ = true;
      return false;
    } catch (const std::bad_alloc&) {
      if (parallel::size() > 1) throw;
      model_->rewind();
      reason_ = fmt::format("the step from {} over {} needs more memory than there is", duration_text(step.start),
                            duration_text(step.dt));
      return false;
    }
    newton_iterations_ += status.iterations;
    if (status.converged) {
      const ScopedTimer timer(profile_, "change of mesh");
      const MeshGrowth::Outcome outcome = growth_.before_acceptance();
      if (outcome == MeshGrowth::Outcome::changed) {
        count_settling();
        has_grown = true;
        continue;
      }
      if (outcome == MeshGrowth::Outcome::failed) return fails_with_growth();
    }
    if (status.converged) {
      // Both before the step is accepted: which cells slip shows in what changed since the last accepted step.
      const std::vector<Quantity> quantities = model_->quantities();
      note_step(step);
      const bool is_steady = stays_as_it_is(step);
      if (is_steady) record_.results["steady_since[s]"] = step.start;
      if (is_steady) ends_early_ = "steady since " + duration_text(step.start);
      if (stop_.is_reached(quantities)) {
        ends_early_ = stop_.text();
        record_.exit_reason = "stopped: " + ends_early_;
      }
      is_stopped_ = !ends_early_.empty();
      const bool writes_fields = is_stopped_ || contains(output_times_, step.end, 1e-9 * model_->scene().time.step);
      const std::vector<OutputField> fields = writes_fields ? model_->output() : std::vector<OutputField>();
      model_->accept();
      controller_.accepted(step, status.iterations);
      const ScopedTimer timer(profile_, "output");
      output_.write_history(step, status.iterations, quantities);
      for (const Quantity& q : quantities) record_.results[labelled(q.name, q.unit)] = q.value;
      last_quantities_ = quantities;
      if (writes_fields) output_.write_fields(step.end, controller_.steps(), model_->mesh(), fields);
      return follows_growth();
    }
    model_->rewind();
    ++rejected_;
    // A step that asks for another size has not failed.
    const bool has_failed = status.retry_dt <= 0;
    reason_ = fmt::format("the step from {} over {} {}: {}", duration_text(step.start), duration_text(step.dt),
                          has_failed ? "did not converge" : "is too long", status.reason);
    if (!controller_.rejected(step, status.retry_dt)) {
      reason_ += " (the step is as small as allowed)";
      return false;
    }
    const std::string next = duration_text(controller_.next().dt);
    progress_.event(has_failed ? fmt::format("step cut: {}; again over {}", reason_, next)
                               : fmt::format("step from {} shortened from {} to {}: {}", duration_text(step.start),
                                             duration_text(step.dt), next, status.reason));
  }
}

ExitCode Run::loop(const InterruptGuard& interrupt) {
  double last_checkpoint = now(), cost = 0;
  const auto checkpoint_is_due = [&] {
    const double due = checkpoint_interval(model_->scene().output.checkpoint_every, now() - began_, cost);
    return parallel::any(now() - last_checkpoint > due);
  };
  using State = std::map<std::string, Vector>;
  const auto steps = [&] {
    State state;
    controller_.save(state);
    return state;
  };
  const auto checkpoint = [&](State extra, const RunOutput::Rows& rows) {
    const double begin = now();
    extra.merge(model_->extra_state());
    books_.save(extra);
    output_.write_checkpoint(*model_, step_notes_, rows, std::move(extra), fingerprint_);
    last_checkpoint = now();
    cost = last_checkpoint - begin;
  };
  while (!controller_.is_finished() && !is_stopped_) {
    const State before = steps();
    const RunOutput::Rows rows_before = output_.rows();
    const bool advanced = advance();
    if (is_interrupted_) {
      checkpoint(before, rows_before);
      return ExitCode::interrupted;
    }
    if (!advanced) {
      checkpoint(steps(), output_.rows());
      return ExitCode::failed;
    }
    progress_.reached(controller_.time(), controller_.steps());
    if (interrupt.is_interrupted() && !controller_.is_finished()) {
      reason_ = "interrupted";
      checkpoint(steps(), output_.rows());
      return ExitCode::interrupted;
    }
    if (checkpoint_is_due()) checkpoint(steps(), output_.rows());
  }
  if (is_stopped_) progress_.stopped(controller_.time(), controller_.steps(), ends_early_);
  checkpoint(steps(), output_.rows());
  return ExitCode::done;
}

void Run::split_steps() {
  const LinearCounts& counts = linear_counts_;
  Profile::Entry& steps = profile_.at("steps");
  const auto move = [&](const Profile::Entry& entry) {
    profile_.at(entry.name) = entry;
    steps.seconds -= entry.seconds;
  };
  move({"linear: ordering", counts.orderings, 0, 0, counts.seconds_ordering, true});
  move({"linear: factorization", counts.factorizations, counts.reused, 0, counts.seconds_factor, true});
  move({"linear: solve", counts.solves, 0, 0, counts.seconds_solve, true});
  steps.seconds += settling_seconds_;
  if (settling_seconds_ > 0) profile_.at("change of mesh").seconds -= settling_seconds_;
  for (const Profile::Entry& entry : efforts_.entries()) move(entry);
}

void Run::finish(ExitCode code) {
  record_.exit_code = static_cast<int>(code);
  if (code != ExitCode::done) record_.exit_reason = reason_;
  if (code == ExitCode::done && record_.exit_reason == "running") record_.exit_reason = "done";
  if (code == ExitCode::done && model_->scene().time.has_stop && !is_stopped_)
    input_notes_.add("time.stop not reached", "time.stop was not reached: the run went on to time.end (" +
                                                  stop_.missed_text(last_quantities_) + ")");
  record_.seconds = now() - began_;
  record_.timings["processor: set-up"] = processor_at_first_step_ - processor_at_start_;
  record_.timings["processor: steps and output"] = processor_now() - processor_at_first_step_;
  record_.counters["steps accepted"] = controller_.steps() - restored_steps_;
  record_.counters["steps rejected"] = rejected_;
  record_.counters["iterations"] = newton_iterations_;
  retire_counts(*model_);
  const LinearCounts& counts = linear_counts_;
  if (growth_.changes() > 0) {
    record_.counters["changes of the mesh"] = growth_.changes();
    record_.results["grown_cells_smallest_angle[rad]"] = growth_.smallest_angle();
  }
  record_.counters["linear: orderings"] = counts.orderings;
  record_.counters["linear: factorizations"] = counts.factorizations;
  record_.counters["linear: factorizations reused"] = counts.reused;
  record_.counters["linear: solves"] = counts.solves;
  record_.counters["linear: iterations"] = counts.iterations;
  record_.counters["linear: condensed factorizations"] = counts.condensed;
  record_.counters["linear: columns condensed"] = counts.columns;
  record_.counters["assembly: patterns"] = counts.patterns;
  record_.counters["assembly: states"] = counts.assemblies;
  split_steps();
  record_.timings["factorizations, back-solves"] = profile_.solver_seconds();
  record_.timings["everything else"] = record_.seconds - profile_.solver_seconds();
  record_.notes = records_of(input_notes_);
  for (NoteRecord& note : records_of(step_notes_)) record_.notes.push_back(std::move(note));
  if (!parallel::is_root()) return;
  record_.write(output_.path() / "run.json", profile_);
  if (!options_.quiet) std::cerr << profile_.table(record_.seconds) << "\n";
  for (const NoteRecord& note : record_.notes) std::cerr << "note: " << described(note) << "\n";
  if (!options_.quiet) {
    if (record_.counters["steps accepted"] == 0 && code == ExitCode::done)
      std::cerr << "nothing was to be done: the run ended at t = " << controller_.time()
                << " s before, and time.end is " << model_->scene().time.end << " s\n";
  }
  if (code != ExitCode::done)
    std::cerr << reason_ << "\nthe checkpoint is " << output_.checkpoint_path().string() << "\n";
  if (!options_.quiet) std::cout << "results: " << output_.path().string() << "\n";
}

/// When what a run has found cannot be written any more: its last checkpoint stays, and what it knows of the tables.
void Run::record_failure(const std::string& reason) {
  if (!parallel::is_root()) return;
  record_.exit_code = static_cast<int>(ExitCode::failed);
  record_.exit_reason = reason;
  record_.seconds = now() - began_;
  try {
    record_.write(output_.path() / "run.json", profile_);
  } catch (const std::exception&) {
    // The reason is told by whoever catches what led here.
  }
  std::error_code error;
  if (std::filesystem::exists(output_.checkpoint_path(), error))
    std::cerr << "the run can go on from its last checkpoint, " << output_.checkpoint_path().string()
              << ", with --restart\n";
}

ExitCode Run::execute() {
  reserve_blas_memory();
  record_start();
  const InterruptGuard interrupt;
  output_.open(continued_, model_->scene().output.fields);
  if (parallel::is_root()) record_.write(output_.path() / "run.json", profile_);
  for (const NoteRecord& note : record_.notes) progress_.event("note: " + described(note));
  ExitCode code = ExitCode::failed;
  try {
    code = loop(interrupt);
  } catch (const std::exception& error) {
    progress_.close();
    record_failure(error.what());
    throw;
  }
  progress_.close();
  finish(code);
  return code;
}

}  // namespace

std::string scene_fingerprint(const Scene& scene) {
  std::string text;
  append_text(scene.whole, text);
  return fingerprint(text);
}

ExitCode run_scene(const Scene& scene, const RunOptions& options) {
  Run run(scene, options);
  return run.execute();
}

}  // namespace sprekk
