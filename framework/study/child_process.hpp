// Programs that run beside this one.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sprekk {

/// A started program. It has a process group of its own, so that Ctrl-C reaches only its parent, which passes it on
/// once.
class ChildProcess {
 public:
  /// Starts `program` with what it prints appended to `log`; the environment is the one that this process was started
  /// with (MPI adds variables that must not be inherited), with `settings` added. Throws std::runtime_error.
  ChildProcess(const std::string& program, const std::vector<std::string>& arguments, const std::filesystem::path& log,
               const std::map<std::string, std::string>& settings);

  /// The exit code once it has ended, minus the signal's number when one ended it. Does not wait.
  std::optional<int> exit_code();
  void signal(int number) const;

 private:
  pid_t process_ = 0;
  std::optional<int> code_;
};

/// Counts SIGINT and SIGTERM while it exists, instead of being ended by them. A terminal (SIGHUP) or a reader (SIGPIPE)
/// that goes away counts as the first of them.
class SignalCounter {
 public:
  SignalCounter();
  ~SignalCounter();
  SignalCounter(const SignalCounter&) = delete;
  SignalCounter& operator=(const SignalCounter&) = delete;
  int count() const;
};

}  // namespace sprekk
