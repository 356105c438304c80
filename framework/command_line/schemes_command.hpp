// `sprekk schemes scene.yaml`: the atlas of coupling schemes.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "framework/schemes/atlas.hpp"

namespace sprekk {

/// The command `schemes` with its arguments.
class SchemesCommand {
 public:
  explicit SchemesCommand(CLI::App& app);
  CLI::App* command() { return command_; }
  bool is_called() const { return command_->parsed(); }
  ExitCode run() const;  ///< throws InputError

 private:
  CLI::App* command_;
  std::string folder_;
  AtlasOptions options_;
};

}  // namespace sprekk
