// Another program that takes part in a run, on any number of processes.
#pragma once

#include <memory>
#include <string>

#include "framework/outside/program_process.hpp"

namespace sprekk {

/// The program of a component. The first process starts it and speaks with it; all others hear its answers.
class OutsideProgram {
 public:
  /// `name`: of the component, for messages. Starts the command; collective, as everything here. Throws OutsideError.
  OutsideProgram(std::string name, const std::string& command, double timeout);

  /// Its answer, whose word is `expected` or "failed". Throws OutsideError, on all processes, where there is none:
  /// then the program is ended. The first answer may take longer than others: programs read much when they start.
  OutsideMessage ask(const OutsideMessage& message, const std::string& expected);
  bool has_failed() const { return has_failed_; }
  double seconds() const { return seconds_; }  ///< between all questions and their answers

 private:
  std::string name_;
  double timeout_, seconds_ = 0;
  bool has_answered_ = false, has_failed_ = false;
  std::unique_ptr<ProgramProcess> process_;  ///< on the first process
};

}  // namespace sprekk
