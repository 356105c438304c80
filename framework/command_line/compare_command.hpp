// `sprekk compare A B …`: how far runs are apart.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "framework/run/exit_code.hpp"

namespace sprekk {

/// The command `compare` with its arguments.
class CompareCommand {
 public:
  explicit CompareCommand(CLI::App& app);
  bool is_called() const { return command_->parsed(); }
  ExitCode run() const;  ///< `differs` beyond the tolerance; throws InputError

 private:
  CLI::App* command_;
  CLI::Option* tolerance_option_;
  std::vector<std::string> folders_, quantities_;
  std::string page_;
  double tolerance_ = 0;
  bool is_quiet_ = false;
};

}  // namespace sprekk
