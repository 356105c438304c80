#include "framework/study/sweep.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <iostream>
#include <list>
#include <thread>

#include "framework/output/build_info.hpp"
#include "framework/output/progress.hpp"
#include "framework/outside/commands.hpp"
#include "framework/plugin/plugin.hpp"
#include "framework/study/child_process.hpp"
#include "framework/study/comparison.hpp"
#include "framework/study/launcher.hpp"
#include "framework/study/run_state.hpp"

namespace sprekk {
namespace fs = std::filesystem;
namespace {

constexpr std::chrono::milliseconds pause_between_looks{20};

/// Only one sweep at a time may work in a folder. The runs inherit the lock: it holds until the last of them ends,
/// however the sweep itself ended.
class FolderLock {
 public:
  explicit FolderLock(const fs::path& folder) {
    const fs::path file = folder / ".sweep.lock";
    file_ = ::open(file.c_str(), O_RDWR | O_CREAT, 0666);
    if (file_ < 0)
      throw InputError("the folder " + folder.string() + " cannot be written to choose another one with -o");
    if (::flock(file_, LOCK_EX | LOCK_NB) != 0)
      throw InputError("another sweep is at work in " + folder.string() +
                       " (or runs that it left behind) wait for it, or choose another folder with -o");
  }
  ~FolderLock() { ::close(file_); }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_;
};

/// One sweep from its first run to its end.
class Sweep {
 public:
  Sweep(const Study& study, const SweepOptions& options);
  ExitCode execute();

 private:
  struct Working {
    std::size_t run;
    ChildProcess process;
    std::size_t launcher;
  };

  void plan();
  void say_plan() const;
  void make_folder() const;
  void start(std::size_t run);
  void collect_ended();
  void finish(const Working& working, int code);
  std::size_t next_launcher(std::size_t run) const;
  void say(const std::string& text) const;
  fs::path run_folder(std::size_t run) const { return folder_ / study_.runs[run].name; }
  fs::path log(std::size_t run) const { return folder_ / (study_.runs[run].name + ".log"); }
  ExitCode outcome(bool interrupted) const;

  const Study& study_;
  const SweepOptions& options_;
  fs::path folder_;
  Comparison comparison_;
  std::vector<RunState> states_;
  std::vector<Action> actions_;
  std::list<Working> working_;
  std::vector<Launcher> launchers_;
  std::vector<std::vector<std::size_t>> lost_by_;  ///< of each run: the launchers that have lost it
  std::vector<std::size_t> again_;                 ///< runs to be repeated
  std::size_t ended_ = 0;
  bool is_interrupted_ = false;
};

Sweep::Sweep(const Study& study, const SweepOptions& options)
    : study_(study),
      options_(options),
      folder_(options.folder.value_or(fs::path("results") / study.name)),
      comparison_(study),
      lost_by_(study.runs.size()) {
  for (const std::string& launcher : options.launchers) launchers_.emplace_back(launcher, Origin{"--launcher"});
  plan();
}

void Sweep::plan() {
  const std::map<std::string, RunState> remembered = read_states(folder_);
  for (const StudyRun& run : study_.runs) {
    actions_.push_back(next_action(run, remembered, folder_));
    const auto found = remembered.find(run.name);
    RunState state;
    if (found != remembered.end() && actions_.back() != Action::start) state = found->second;
    state.name = run.name;
    state.identity = run.identity;
    states_.push_back(state);
  }
}

void Sweep::say(const std::string& text) const {
  if (!options_.quiet) std::cerr << text << std::endl;
}

void Sweep::say_plan() const {
  const auto count = [&](Action action) { return std::count(actions_.begin(), actions_.end(), action); };
  say(fmt::format("{}: {} runs, {} done before, {} to go on, {} new", study_.name, study_.runs.size(),
                  count(Action::keep), count(Action::go_on), count(Action::start)));
}

void Sweep::make_folder() const {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error || !fs::is_directory(folder_))
    throw InputError("the folder " + folder_.string() + " cannot be made choose another one with -o");
}

void Sweep::start(std::size_t i) {
  const StudyRun& run = study_.runs[i];
  const bool goes_on = actions_[i] == Action::go_on;
  std::vector<std::string> arguments = {"run"};
  arguments.insert(arguments.end(), study_.scene_files.begin(), study_.scene_files.end());
  for (const Setting& setting : run.settings)
    arguments.insert(arguments.end(), {"--set", setting.path + "=" + setting.value});
  // A run that was stopped before its first checkpoint starts anew.
  if (!goes_on) fs::remove_all(run_folder(i));
  arguments.insert(arguments.end(), {"-o", run_folder(i).string()});
  if (goes_on) arguments.emplace_back("--restart");
  std::map<std::string, std::string> environment = plugin_environment();
  environment.merge(program_environment());
  environment.insert({{"OPENBLAS_NUM_THREADS", "1"}, {"OMP_NUM_THREADS", "1"}});
  if (launchers_.empty()) {
    working_.push_back({i, ChildProcess(options_.program, arguments, log(i), environment), 0});
    return;
  }
  // Elsewhere this process is not known.
  arguments.insert(arguments.begin(), fs::canonical(options_.program).string());
  const std::size_t launcher = next_launcher(i);
  std::vector<std::string> words = launchers_[launcher].words(arguments, environment);
  const std::string program = words.front();
  words.erase(words.begin());
  working_.push_back({i, ChildProcess(program, words, log(i), environment), launcher});
}

/// The launcher with the fewest runs, of those that have not lost this one.
std::size_t Sweep::next_launcher(std::size_t run) const {
  std::vector<std::size_t> load(launchers_.size());
  for (const Working& working : working_) ++load[working.launcher];
  // A launcher that has lost this run comes after all that have not, whatever their number of runs.
  for (const std::size_t launcher : lost_by_[run]) load[launcher] += study_.runs.size();
  return static_cast<std::size_t>(std::ranges::min_element(load) - load.begin());
}

void Sweep::finish(const Working& working, int code) {
  const std::size_t i = working.run;
  RunState& state = states_[i];
  const double before = state.seconds;
  record_end(state, code, run_folder(i), log(i), !launchers_.empty());
  if (state.is_lost && static_cast<int>(lost_by_[i].size()) < options_.repeats && !is_interrupted_) {
    lost_by_[i].push_back(working.launcher);
    actions_[i] = fs::exists(run_folder(i) / "checkpoint.h5") ? Action::go_on : Action::start;
    again_.push_back(i);
    say(fmt::format("{}: lost by '{}' ({}), and repeated", state.name, launchers_[working.launcher].text(),
                    state.reason));
    return;
  }
  const std::string seconds = duration_text(state.seconds - before);
  const bool has_failed = state.status == RunState::Status::failed;
  const std::string text =
      fmt::format("[{}/{}] {}: {} {}", ++ended_, study_.runs.size(), state.name, status_text(state.status),
                  has_failed ? "(" + state.reason + ")" : "after " + seconds);
  if (has_failed && options_.tells_failures)
    std::cerr << text << std::endl;
  else
    say(text);
  comparison_.write_record(folder_, states_);
}

void Sweep::collect_ended() {
  for (auto it = working_.begin(); it != working_.end();) {
    const std::optional<int> code = it->process.exit_code();
    if (code) finish(*it, *code);
    it = code ? working_.erase(it) : std::next(it);
  }
}

ExitCode Sweep::outcome(bool interrupted) const {
  if (interrupted) return ExitCode::interrupted;
  const bool is_done = std::all_of(states_.begin(), states_.end(),
                                   [](const RunState& state) { return state.status == RunState::Status::done; });
  return is_done ? ExitCode::done : ExitCode::failed;
}

ExitCode Sweep::execute() {
  if (options_.only_list) {
    static const char* const names[] = {"keep", "start", "go on"};
    for (std::size_t i = 0; i < study_.runs.size(); ++i)
      std::cout << fmt::format("{:<6} {}\n", names[static_cast<int>(actions_[i])], study_.runs[i].name);
    return ExitCode::done;
  }
  make_folder();
  const FolderLock lock(folder_);
  say_plan();
  const SignalCounter signals;
  for (std::size_t i = 0; i < states_.size(); ++i)
    if (actions_[i] == Action::keep) {
      ++ended_;
      if (states_[i].status != RunState::Status::done) record_end(states_[i], 0, run_folder(i), log(i));
    }
  comparison_.write_record(folder_, states_);
  const std::size_t at_a_time = static_cast<std::size_t>(options_.processes > 0 ? options_.processes : host().cores);
  int passed_on = 0;
  for (std::size_t next = 0; next < states_.size() || !working_.empty() || !again_.empty();) {
    if (next < states_.size() && actions_[next] == Action::keep) {
      ++next;
      continue;
    }
    if (passed_on < signals.count()) {
      passed_on = signals.count();
      next = states_.size();  // no further run is started
      again_.clear();
      is_interrupted_ = true;
      for (const Working& working : working_) working.process.signal(SIGINT);
      say("interrupted: the runs end after the steps that they are in");
    }
    if (!again_.empty() && working_.size() < at_a_time) {
      start(again_.front());
      again_.erase(again_.begin());
      continue;
    }
    if (next < states_.size() && working_.size() < at_a_time) {
      start(next++);
      continue;
    }
    std::this_thread::sleep_for(pause_between_looks);
    collect_ended();
  }
  comparison_.write(folder_, states_);
  if (!options_.quiet && options_.has_table) {
    std::cout << comparison_.text(folder_, states_);
    std::cout << "results: " << (folder_ / "sweep.csv").string() << "\n";
  }
  return outcome(passed_on > 0);
}

}  // namespace

ExitCode run_sweep(const Study& study, const SweepOptions& options) { return Sweep(study, options).execute(); }

}  // namespace sprekk
