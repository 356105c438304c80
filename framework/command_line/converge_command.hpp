// `sprekk converge scene.yaml --of QUANTITY`: value and error.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "framework/converge/convergence.hpp"

namespace sprekk {

/// The command `converge` with its arguments.
class ConvergeCommand {
 public:
  explicit ConvergeCommand(CLI::App& app);
  CLI::App* command() { return command_; }
  bool is_called() const { return command_->parsed(); }
  ExitCode run() const;  ///< throws InputError

 private:
  CLI::App* command_;
  std::string folder_;
  ConvergenceOptions options_;
};

}  // namespace sprekk
