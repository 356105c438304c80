// What a program is asked in the course of a run, and what it keeps from step to step.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "framework/assembly/step_time.hpp"
#include "framework/outside/outside_program.hpp"

namespace sprekk::outside {

/// Leads the program through steps that are repeated, taken back, cut into substeps or accepted. The program keeps
/// states at two times: that of the last accepted step, and that at the start of the step (or substep) that it solves
/// now, the base.
class Conversation {
 public:
  /// Starts the program, and greets it. `kept`: what it has kept at a checkpoint, or nothing. Throws OutsideError.
  Conversation(const std::string& name, const std::string& command, double timeout, const OutsideMessage& hello,
               std::map<std::string, Vector> kept);

  /// The values at the end of a step. `begin`: tells what holds at its start, where the program does not know that yet.
  /// Throws OutsideError; StateError where the program says that it cannot take the step.
  OutsideMessage solve(const StepTime& step, const std::function<void(OutsideMessage&)>& tell_start,
                       OutsideMessage fields);
  void accept();
  void rewind();

  /// What the program keeps, as of the last accepted step.
  const std::map<std::string, Vector>& kept() const { return kept_; }
  long solves() const { return solves_; }
  double seconds_of_solves() const { return seconds_of_solves_; }  ///< with what goes before a solve
  bool repeats_bits() const { return repeats_bits_; }

 private:
  OutsideMessage ask(OutsideMessage message, const std::string& expected);
  void go_to(const StepTime& step, const std::function<void(OutsideMessage&)>& tell_start);

  std::string name_;
  OutsideProgram program_;
  std::map<std::string, Vector> kept_;
  bool has_begun_ = false, has_solved_ = false;  ///< the step `step_`
  bool is_base_accepted_ = true;                 ///< whether the base is the last accepted state
  StepTime step_;
  long solves_ = 0;
  double seconds_of_solves_ = 0;
  bool repeats_bits_ = true;
};

}  // namespace sprekk::outside
