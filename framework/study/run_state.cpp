#include "framework/study/run_state.hpp"

#include <array>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "framework/output/output_folder.hpp"
#include "framework/run/exit_code.hpp"

namespace sprekk {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

constexpr std::array<std::pair<RunState::Status, const char*>, 4> statuses = {
    {{RunState::Status::waiting, "waiting"},
     {RunState::Status::done, "done"},
     {RunState::Status::failed, "failed"},
     {RunState::Status::interrupted, "interrupted"}}};

RunState::Status status_of(const std::string& text) {
  for (const auto& [status, name] : statuses)
    if (text == name) return status;
  return RunState::Status::waiting;
}

json read_json(const fs::path& file) {
  std::ifstream stream(file);
  return json::parse(stream, nullptr, false);
}

/// The last line that is not empty: the message of a run that ended before it could write its record.
std::string last_line(const fs::path& log) {
  std::ifstream stream(log);
  std::string last;
  for (std::string line; std::getline(stream, line);)
    if (!line.empty()) last = line;
  return last.rfind("error: ", 0) == 0 ? last.substr(7) : last;
}

bool is_free(const fs::path& folder) { return !fs::exists(folder) || !OutputFolder::holds_results(folder); }

}  // namespace

std::string status_text(RunState::Status status) {
  for (const auto& [value, name] : statuses)
    if (value == status) return name;
  return "";
}

std::map<std::string, RunState> read_states(const fs::path& folder) {
  std::map<std::string, RunState> states;
  const fs::path file = folder / "sweep.json";
  if (!fs::exists(file)) return states;
  const auto damaged = [&] {
    return InputError(file.string() +
                      " is not the record of a study (it is damaged, or another file) choose another folder with -o");
  };
  const json record = read_json(file);
  if (!record.is_object() || !record.contains("runs") || !record["runs"].is_array()) throw damaged();
  for (const json& run : record["runs"]) {
    try {
      RunState state;
      state.name = run.at("name");
      state.identity = run.at("identity");
      state.status = status_of(run.at("state"));
      state.exit_code = run.at("exit_code");
      state.reason = run.at("reason");
      state.seconds = run.at("seconds");
      state.program = run.at("program");
      states[state.name] = state;
    } catch (const json::exception&) {
      throw damaged();
    }
  }
  return states;
}

Action next_action(const StudyRun& run, const std::map<std::string, RunState>& remembered, const fs::path& folder) {
  const fs::path run_folder = folder / run.name;
  if (is_free(run_folder)) return Action::start;
  const auto state = remembered.find(run.name);
  if (state == remembered.end() || state->second.identity != run.identity)
    throw InputError("the folder " + run_folder.string() + " holds a run " +
                     (state == remembered.end() ? "that this study does not know" : "of other values") +
                     " (results are never overwritten) choose another folder with -o, or remove this one");
  if (state->second.status == RunState::Status::done) return Action::keep;
  // A run may have ended well after the sweep was killed.
  const json record = read_json(run_folder / "run.json");
  if (record.is_object() && record.value("/exit/code"_json_pointer, -1) == 0) return Action::keep;
  return fs::exists(run_folder / "checkpoint.h5") ? Action::go_on : Action::start;
}

void record_end(RunState& state, int code, const fs::path& run_folder, const fs::path& log, bool launched) {
  using Status = RunState::Status;
  const json record = read_json(run_folder / "run.json");
  const bool is_whole = record.is_object() && record.contains("exit") && record.contains("program");
  const int own = is_whole ? record["exit"].value("code", -1) : -1;
  // The end that a run has recorded counts more than the exit code of its launcher: the connection may be lost after
  // the last step.
  if (launched && own == static_cast<int>(ExitCode::done)) code = own;
  state.is_lost = launched && code != own && code != static_cast<int>(ExitCode::wrong_input);
  state.exit_code = code;
  state.status = code == static_cast<int>(ExitCode::done)          ? Status::done
                 : code == static_cast<int>(ExitCode::interrupted) ? Status::interrupted
                                                                   : Status::failed;
  state.reason.clear();
  if (is_whole) {
    state.seconds += record.value("seconds", 0.0);
    state.program = record["program"].value("version", "") + " " + record["program"].value("git_commit", "");
  }
  if (state.status != Status::failed) return;
  if (code < 0)
    state.reason = std::string("ended by a signal: ") + strsignal(-code);
  else if (is_whole && record["exit"].value("code", -1) == code)
    state.reason = record["exit"].value("reason", "");
  else
    state.reason = last_line(log);
}

}  // namespace sprekk
