// Another program that was started and is spoken to through its standard input and output.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>

#include "framework/outside/message.hpp"

namespace sprekk {

/// A started program. It has a process group of its own, so that Ctrl-C reaches this program only, which ends the
/// other. Its standard error is that of this program.
class ProgramProcess {
 public:
  /// Starts a command of the shell. Throws OutsideError.
  explicit ProgramProcess(const std::string& command);
  /// Closes both pipes, waits a little for the program to end, and ends it otherwise: it leaves nothing behind.
  ~ProgramProcess();
  ProgramProcess(const ProgramProcess&) = delete;
  ProgramProcess& operator=(const ProgramProcess&) = delete;

  /// Sends a message and waits for the answer. Throws OutsideError when the program has ended, says nothing for
  /// `patience`, or what it says is no message; Interrupted where the user ends the run meanwhile.
  OutsideMessage ask(const OutsideMessage& message, std::chrono::duration<double> patience);

 private:
  void send(const std::string& bytes, std::chrono::steady_clock::time_point end);
  OutsideMessage receive(std::chrono::steady_clock::time_point end);
  /// Waits until a pipe is ready for reading (or writing).
  void wait_for(int pipe, short event, std::chrono::steady_clock::time_point end) const;
  std::string how_it_ended();  ///< waits a little for it
  bool has_ended(std::chrono::milliseconds patience);

  pid_t process_ = 0;
  int to_ = -1, from_ = -1;  ///< pipes
  bool is_reaped_ = false;
  int status_ = 0;
  double patience_ = 0;  ///< s, for messages
};

}  // namespace sprekk
