#include "framework/command_line/converge_command.hpp"

#include "framework/config/input_error.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {

ConvergeCommand::ConvergeCommand(CLI::App& app)
    : command_(app.add_subcommand("converge", "Tells quantities with their errors, from runs with finer parameters")) {
  command_->add_option("scene", options_.scene_files, "Scene files; later ones override earlier ones")
      ->required()
      ->type_name("SCENE");
  command_->add_option("--of", options_.quantities, "A column of history.csv: a, a@6h, a@largest; several of them")
      ->required()
      ->expected(1)
      ->take_all()
      ->type_name("QUANTITY");
  command_->add_option("--to", options_.to, "Runs the cheapest setting with this error, for example 1%")
      ->type_name("ERROR");
  command_->add_option("--refine", options_.refine, "Refines this only: mesh, step, increment, or a value by its path")
      ->expected(1)
      ->take_all()
      ->type_name("WHAT");
  command_
      ->add_option("--coarsest", options_.coarsest,
                   "The coarsest of three levels, over the scene's values; 2 by default")
      ->type_name("FACTOR")
      ->check(CLI::Range(0.001, 64.0));
  command_->add_option("--set", options_.settings, "Overrides a value of the scene: path=value")
      ->expected(1)
      ->take_all()
      ->type_name("PATH=VALUE");
  command_->add_option("-o,--output", folder_, "Folder for the runs; results/<scene>_converge by default")
      ->type_name("FOLDER");
  command_->add_option("-j,--jobs", options_.processes, "Runs at a time; as many as there are cores by default")
      ->type_name("COUNT")
      ->check(CLI::Range(1, 1024));
  command_->add_flag("-q,--quiet", options_.is_quiet, "Prints nothing unless something is wrong");
}

ExitCode ConvergeCommand::run() const {
  if (parallel::size() > 1)
    throw InputError({"sprekk converge"}, "a study cannot be distributed", "it starts processes of its own",
                     "call it without mpirun");
  ConvergenceOptions options = options_;
  if (!folder_.empty()) options.folder = folder_;
  return run_convergence(options);
}

}  // namespace sprekk
