// Commands that run a scene many times, each time in a process of its own: `sprekk sweep`, `converge` and `schemes`.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "framework/config/input_error.hpp"
#include "framework/converge/convergence.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/schemes/atlas.hpp"
#include "framework/study/sweep.hpp"

namespace sprekk {

/// A command with its arguments.
template <class Options>
class StudyCommand {
 public:
  explicit StudyCommand(CLI::App& app);
  CLI::App* command() { return command_; }
  bool is_called() const { return command_->parsed(); }
  ExitCode run() const;  ///< throws InputError

 private:
  CLI::App* command_;
  std::string study_, folder_;
  Options options_;
};

using SweepCommand = StudyCommand<SweepOptions>;
using ConvergeCommand = StudyCommand<ConvergenceOptions>;
using SchemesCommand = StudyCommand<AtlasOptions>;
template <>
SweepCommand::StudyCommand(CLI::App& app);
template <>
ConvergeCommand::StudyCommand(CLI::App& app);
template <>
SchemesCommand::StudyCommand(CLI::App& app);
template <>
ExitCode SweepCommand::run() const;
template <>
ExitCode ConvergeCommand::run() const;
template <>
ExitCode SchemesCommand::run() const;

/// A text that may be given several times, once each.
template <class Target>
void add_texts(CLI::App& command, const std::string& name, Target& target, const std::string& doc,
               const std::string& type) {
  command.add_option(name, target, doc)->expected(1)->take_all()->type_name(type);
}

inline void add_settings(CLI::App& command, std::vector<std::string>& settings) {
  add_texts(command, "--set", settings, "Overrides a value of the scene: path=value", "PATH=VALUE");
}

/// Where the runs go, and how many there are at a time.
inline void add_runs(CLI::App& command, std::string& folder, const std::string& doc, int& processes) {
  command.add_option("-o,--output", folder, doc)->type_name("FOLDER");
  command.add_option("-j,--jobs", processes, "Runs at a time; as many as there are cores by default")
      ->type_name("COUNT")
      ->check(CLI::Range(1, 1024));
}

inline void add_quiet(CLI::App& command, bool& is_quiet) {
  command.add_flag("-q,--quiet", is_quiet, "Prints nothing unless something is wrong");
}

/// The options with the folder that was given. Throws InputError under mpirun.
template <class Options>
Options options_of_study(Options options, const std::string& folder, const std::string& name) {
  if (parallel::size() > 1)
    throw InputError({"sprekk " + name}, "a study cannot be distributed", "it starts processes of its own",
                     "call it without mpirun");
  if (!folder.empty()) options.folder = folder;
  return options;
}

}  // namespace sprekk
