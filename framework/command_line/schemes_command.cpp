#include "framework/command_line/schemes_command.hpp"

#include "framework/config/input_error.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {

SchemesCommand::SchemesCommand(CLI::App& app)
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
  command_
      ->add_option("--accelerate", options_.accelerations,
                   "An accelerator beside none, for example 'iqn_ils: {reuse: 2}'; the usual ones by default")
      ->expected(1)
      ->take_all()
      ->type_name("ACCELERATOR");
  command_->add_option("--only", options_.only, "Only schemes whose names hold this text")
      ->expected(1)
      ->take_all()
      ->type_name("TEXT");
  command_
      ->add_option("--over", options_.over,
                   "Draws maps over a value of the scene: path=a,b,c; over two if it is given twice")
      ->expected(1)
      ->take_all()
      ->type_name("PATH=VALUES");
  command_->add_option("--set", options_.settings, "Overrides a value of the scene: path=value")
      ->expected(1)
      ->take_all()
      ->type_name("PATH=VALUE");
  command_->add_option("-o,--output", folder_, "Folder for the runs; results/<scene>_schemes by default")
      ->type_name("FOLDER");
  command_->add_option("-j,--jobs", options_.processes, "Runs at a time; as many as there are cores by default")
      ->type_name("COUNT")
      ->check(CLI::Range(1, 1024));
  command_->add_flag("-q,--quiet", options_.is_quiet, "Prints nothing unless something is wrong");
}

ExitCode SchemesCommand::run() const {
  if (parallel::size() > 1)
    throw InputError({"sprekk schemes"}, "a study cannot be distributed", "it starts processes of its own",
                     "call it without mpirun");
  AtlasOptions options = options_;
  if (!folder_.empty()) options.folder = folder_;
  return run_atlas(options);
}

}  // namespace sprekk
