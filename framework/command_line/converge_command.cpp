#include "framework/command_line/study_command.hpp"

namespace sprekk {

template <>
ConvergeCommand::StudyCommand(CLI::App& app)
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
  add_texts(*command_, "--refine", options_.refine, "Refines this only: mesh, step, increment, or a value by its path",
            "WHAT");
  command_
      ->add_option("--coarsest", options_.coarsest,
                   "The coarsest of three levels, over the scene's values; 2 by default")
      ->type_name("FACTOR")
      ->check(CLI::Range(0.001, 64.0));
  add_settings(*command_, options_.settings);
  add_runs(*command_, folder_, "Folder for the runs; results/<scene>_converge by default", options_.processes);
  add_quiet(*command_, options_.is_quiet);
}

template <>
ExitCode ConvergeCommand::run() const {
  return run_convergence(options_of_study(options_, folder_, "converge"));
}

}  // namespace sprekk
