// Programs that run beside this one.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sprekk {

/// A started program. It has a process group of its own, so that Ctrl-C reaches only its parent, which passes the
/// signal on once.
class ChildProcess {
 public:
  /// Starts `program`, which is looked for along the path where it is a name alone, and whose output is appended to
  /// `log`. Its environment is the environment that this process was started with (MPI adds variables that must not be
  /// inherited) and `settings`. Throws std::runtime_error.
  ChildProcess(const std::string& program, const std::vector<std::string>& arguments, const std::filesystem::path& log,
               const std::map<std::string, std::string>& settings);

  /// The exit code of a program that has ended, or minus the number of the signal that ended it. Does not wait.
  std::optional<int> exit_code();
  void signal(int number) const;

 private:
  pid_t process_ = 0;
  std::optional<int> code_;
};

/// A guard that counts SIGINT and SIGTERM while it exists, so that they do not end the process. The end of the terminal
/// (SIGHUP) or of the reader (SIGPIPE) counts as a first signal.
class SignalCounter {
 public:
  SignalCounter();
  ~SignalCounter();
  SignalCounter(const SignalCounter&) = delete;
  SignalCounter& operator=(const SignalCounter&) = delete;
  int count() const;
};

}  // namespace sprekk
