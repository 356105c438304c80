#include "framework/command_line/study_command.hpp"

namespace sprekk {

template <>
SchemesCommand::StudyCommand(CLI::App& app)
    : command_(app.add_subcommand(
          "schemes",
          "Runs all sensible ways to solve a scene's components apart, and compares their cost and answers")) {
  command_->add_option("scene", options_.scene_files, "Files of the scene")->required()->type_name("SCENE");
  command_->add_option("--steps", options_.steps, "Time steps of each run; 3 by default")
      ->type_name("COUNT")
      ->check(CLI::Range(1, 1000000));
  command_->add_option("--until", options_.until, "Coupled residual that ends an iteration; by default as in a scene")
      ->type_name("RESIDUAL")
      ->check(CLI::Range(1e-14, 0.1));
  command_->add_option("--at-most", options_.at_most, "Passes before a step is refused; 60 by default")
      ->type_name("COUNT")
      ->check(CLI::Range(1, 100000));
  add_texts(*command_, "--accelerate", options_.accelerations,
            "An accelerator beside none, for example 'iqn_ils: {reuse: 2}'; the usual ones by default", "ACCELERATOR");
  add_texts(*command_, "--only", options_.only, "Only schemes whose names hold this text", "TEXT");
  add_texts(*command_, "--over", options_.over,
            "Draws maps over a value of the scene: path=a,b,c; over two if it is given twice", "PATH=VALUES");
  add_settings(*command_, options_.settings);
  add_runs(*command_, folder_, "Folder for the runs; results/<scene>_schemes by default", options_.processes);
  add_quiet(*command_, options_.is_quiet);
}

template <>
ExitCode SchemesCommand::run() const {
  return run_atlas(options_of_study(options_, folder_, "schemes"));
}

}  // namespace sprekk
