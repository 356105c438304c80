// `sprekk sweep study.yaml`: a study over any values of a scene.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "framework/study/sweep.hpp"

namespace sprekk {

/// The command `sweep` with its arguments.
class SweepCommand {
 public:
  explicit SweepCommand(CLI::App& app);
  CLI::App* command() { return command_; }
  bool is_called() const { return command_->parsed(); }
  ExitCode run() const;  ///< throws InputError

 private:
  CLI::App* command_;
  std::string study_, folder_;
  SweepOptions options_;
};

}  // namespace sprekk
