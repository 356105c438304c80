#include "framework/command_line/sweep_command.hpp"

#include "framework/parallel/parallel.hpp"

namespace sprekk {

SweepCommand::SweepCommand(CLI::App& app)
    : command_(app.add_subcommand("sweep", "Runs a study over any values of a scene, in parallel processes")) {
  command_->add_option("study", study_, "The file of the study")->required()->type_name("STUDY");
  command_->add_option("-o,--output", folder_, "Folder for the results; results/<study> by default")
      ->type_name("FOLDER");
  command_->add_option("-j,--jobs", options_.processes, "Runs at a time; as many as there are cores by default")
      ->type_name("COUNT")
      ->check(CLI::Range(1, 1024));
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
  command_->add_flag("-q,--quiet", options_.quiet, "Prints nothing unless something is wrong");
}

ExitCode SweepCommand::run() const {
  if (parallel::size() > 1)
    throw InputError({"sprekk sweep"}, "a sweep cannot be distributed", "it starts processes of its own",
                     "call it without mpirun");
  SweepOptions options = options_;
  if (!folder_.empty()) options.folder = folder_;
  return run_sweep(read_study(study_), options);
}

}  // namespace sprekk
