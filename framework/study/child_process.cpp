#include "framework/study/child_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <csignal>
#include <cstring>
#include <stdexcept>

#include "framework/parallel/environment_at_start.hpp"

namespace sprekk {
namespace {

volatile std::sig_atomic_t signals_received = 0;

void count_signal(int) { signals_received = signals_received + 1; }

/// When a terminal or a reader goes away, the signal comes more than once.
void count_loss(int) {
  if (signals_received == 0) signals_received = 1;
}

std::vector<std::string> environment(const std::map<std::string, std::string>& settings) {
  std::vector<std::string> variables = parallel::environment_at_start();
  std::erase_if(variables, [&](const std::string& variable) {
    return settings.count(variable.substr(0, variable.find('='))) > 0;
  });
  for (const auto& [name, value] : settings) variables.push_back(name + "=" + value);
  return variables;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

/// A guard for the objects of posix_spawn that must be freed.
struct SpawnSettings {
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  SpawnSettings() {
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
  }
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
  }
};

}  // namespace

ChildProcess::ChildProcess(const std::string& program, const std::vector<std::string>& arguments,
                           const std::filesystem::path& log, const std::map<std::string, std::string>& settings) {
  std::vector<std::string> words = {program}, variables = environment(settings);
  words.insert(words.end(), arguments.begin(), arguments.end());
  SpawnSettings spawn;
  posix_spawn_file_actions_addopen(&spawn.actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&spawn.actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0666);
  posix_spawn_file_actions_adddup2(&spawn.actions, 1, 2);
  posix_spawnattr_setflags(&spawn.attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&spawn.attributes, 0);
  const int failure = posix_spawnp(&process_, program.c_str(), &spawn.actions, &spawn.attributes,
                                   pointers(words).data(), pointers(variables).data());
  if (failure != 0) throw std::runtime_error("cannot start " + program + " (" + std::strerror(failure) + ")");
}

std::optional<int> ChildProcess::exit_code() {
  int status = 0;
  if (!code_ && waitpid(process_, &status, WNOHANG) == process_)
    code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return code_;
}

void ChildProcess::signal(int number) const {
  if (!code_) kill(process_, number);
}

SignalCounter::SignalCounter() {
  signals_received = 0;
  std::signal(SIGINT, count_signal);
  std::signal(SIGTERM, count_signal);
  for (const int signal : {SIGHUP, SIGPIPE})
    if (std::signal(signal, SIG_IGN) != SIG_IGN) std::signal(signal, count_loss);
}

SignalCounter::~SignalCounter() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

int SignalCounter::count() const { return signals_received; }

}  // namespace sprekk
