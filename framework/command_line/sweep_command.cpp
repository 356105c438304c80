#include "framework/command_line/study_command.hpp"

namespace sprekk {

template <>
SweepCommand::StudyCommand(CLI::App& app)
    : command_(app.add_subcommand("sweep", "Runs a study over any values of a scene, in parallel processes")) {
  command_->add_option("study", study_, "The file of the study")->required()->type_name("STUDY");
  add_runs(*command_, folder_, "Folder for the results; results/<study> by default", options_.processes);
  command_
      ->add_option("--launcher", options_.launchers,
                   "A command that starts runs, as 'srun', or a template, as 'ssh node2 {command}'; also "
                   "several times")
      ->type_name("COMMAND")
      ->allow_extra_args(false);
  command_
      ->add_option("--repeats", options_.repeats, "How often a run that a launcher has lost is repeated; 2 by default")
      ->type_name("COUNT")
      ->check(CLI::Range(0, 100));
  command_->add_flag("--list", options_.only_list, "Says what would be done with each run, and does nothing");
  add_quiet(*command_, options_.quiet);
}

template <>
ExitCode SweepCommand::run() const {
  const SweepOptions options = options_of_study(options_, folder_, "sweep");
  return run_sweep(read_study(study_), options);
}

}  // namespace sprekk
