#include "framework/command_line/command_line.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <iostream>
#include <string_view>
#include <utility>

#include "framework/command_line/compare_command.hpp"
#include "framework/command_line/completion.hpp"
#include "framework/command_line/explain_command.hpp"
#include "framework/command_line/graph_command.hpp"
#include "framework/command_line/hand_over.hpp"
#include "framework/command_line/manual_page.hpp"
#include "framework/command_line/new_command.hpp"
#include "framework/command_line/scene_arguments.hpp"
#include "framework/command_line/study_command.hpp"
#include "framework/config/describe/resolved_yaml.hpp"
#include "framework/linear/linear_solver.hpp"
#include "framework/meshing/fracture_table.hpp"
#include "framework/output/activity.hpp"
#include "framework/output/build_info.hpp"
#include "framework/output/output_folder.hpp"
#include "framework/output/progress.hpp"
#include "framework/outside/commands.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/plugin/plugin.hpp"
#include "framework/report/report.hpp"
#include "framework/run/note_records.hpp"
#include "framework/run/simulation.hpp"
#include "framework/run/start_notes.hpp"
#include "framework/run/stop_condition.hpp"
#include "framework/scene/scene_dimension.hpp"
#include "framework/scene/state_of_run.hpp"

namespace sprekk {

namespace {

std::string version_text() {
  const BuildInfo& build = build_info();
  const BlasInfo blas = blas_in_use();
  std::string text = "sprekk " + build.version + " " + build.git_commit + "\n" + build.compiler + ", " +
                     build.build_type + "\nBLAS: " + blas.name +
                     (blas.is_reference ? " (slow: install libopenblas0-pthread)" : "") + "\n";
  for (const auto& [name, version] : build.libraries) text += name + " " + version + "\n";
  return text;
}

void print_scene(const Scene& scene) {
  std::vector<ResolvedValue> values;
  for (const Scene::Resolved& r : scene.resolved) values.push_back({r.path, r.value, r.origin});
  std::cout << resolved_yaml(values);
}

void check_scene(const Scene& scene) {
  const bool is_watched = Progress::style_for(STDERR_FILENO, parallel::is_root(), false) == Progress::Style::bar;
  Progress progress(is_watched ? Progress::Style::bar : Progress::Style::silent, std::cerr, scene.time.start,
                    scene.time.end);
  const ActivityListener listener([&](const std::string& what) { progress.part(what); });
  progress.watch();
  progress.phase("building the model");
  Model model(scene);
  if (scene.start.from) take_state_of_run(*scene.start.from, model);
  StopCondition(scene, model.quantities());
  long unknowns = 0;
  for (const Field* field : model.schedule().unknowns()) unknowns += field->size();
  const Notes notes = start_notes(model, mesh_quality(model.mesh()), unknowns);
  model.require_held();
  progress.close();
  if (!parallel::is_root()) return;
  for (const NoteRecord& note : records_of(notes)) std::cerr << "note: " << described(note) << "\n";
  std::cout << scene.name << ": ok, " << model.mesh().cell_count() << " cells, " << model.mesh().fracture_cell_count()
            << " fracture cells\n";
}

std::filesystem::path find_checkpoint(const std::string& given, const std::string& folder, const Scene& scene) {
  if (!given.empty() && !folder.empty()) {
    const std::filesystem::path beside = std::filesystem::absolute(given).parent_path();
    if (beside.lexically_normal() != (std::filesystem::absolute(folder) / "").lexically_normal().parent_path())
      throw InputError({"--output " + folder}, "a run goes on in the folder of its checkpoint",
                       "the checkpoint is in " + beside.string(),
                       "leave -o out; to keep the old results, copy their folder and restart the copy");
  }
  if (!given.empty()) return given;
  if (!folder.empty()) return std::filesystem::path(folder) / "checkpoint.h5";
  return OutputFolder::default_path(scene.name) / "checkpoint.h5";
}

/// Throws InputError for a missing or misspelt command.
void require_command(const CLI::App& app, int argc, char** argv) {
  if (argc > 1 && argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  if (argc < 2)
    throw InputError({"sprekk"}, "a command is missing", "it is one of: " + listed(names), "see 'sprekk --help'");
  if (std::find(names.begin(), names.end(), argv[1]) == names.end())
    throw unknown_name({"sprekk", 0, 0}, "command", argv[1], names);
}

/// A file behind `--restart` with the ending of a scene is the scene, not the checkpoint: the option is moved behind
/// it.
void let_restart_follow_scenes(int argc, char** argv) {
  const auto is_scene = [](std::string_view name) { return name.ends_with(".yaml") || name.ends_with(".yml"); };
  for (int i = 1; i + 1 < argc; ++i)
    if (std::string_view(argv[i]) == "--restart" && is_scene(argv[i + 1])) std::swap(argv[i], argv[i + 1]);
}

/// Every process finds a mistake of the input, so the first one reports it. A folder that cannot be written may be
/// known to the first process only.
int answer_wrong_input(const InputError& error) {
  if (parallel::is_root()) std::cerr << "error: " << error.what() << "\n";
  return static_cast<int>(ExitCode::wrong_input);
}

/// All commands with their arguments.
class Commands {
 public:
  Commands(CLI::App& app, const ProgramPurpose& purpose)
      : app_(app), purpose_(purpose), new_plugin_(app, purpose.templates) {
    declare_of_scenes();
    declare_texts();
    declare_plugins();
    declare_programs();
  }

  /// Does what the arguments, which have been parsed, ask for.
  ExitCode run() {
    if (!scene_.files.empty()) require_dimension(scene_.load(), scene_.folder());
    take_plugins_of_environment();
    for (const std::string& file : plugins_) load_plugin_of_user(file, {"--plugin"});
    for (const std::string& folder : plugin_folders_) trust_plugins_in(folder, {"--plugins"});
    for (const std::string& program : programs_) take_program(program, {"--program"});
    take_programs_of_environment();
    print_texts();
    if (*show_) print_scene(scene_.read());
    if (*fractures_) std::cout << fracture_table(scene_.read().geometry.fractures);
    if (*graph_) draw_graph(Model(scene_.read()), picture_);
    if (*check_) check_scene(scene_.read());
    if (*report_) std::cout << "report: " << write_report(reported_).string() << "\n";
    if (new_plugin_.is_called()) new_plugin_.run();
    if (compare_.is_called()) return compare_.run();
    if (converge_.is_called()) return converge_.run();
    if (schemes_.is_called()) return schemes_.run();
    if (sweep_.is_called()) return sweep_.run();
    return *run_ ? run_of_user() : ExitCode::done;
  }

 private:
  void declare_of_scenes() {
    for (CLI::App* command : {run_, check_, show_, fractures_, graph_}) scene_.add_to(*command);
    run_->add_option("-o,--output", folder_, "Folder for the results; results/<scene> by default")->type_name("FOLDER");
    restart_ = run_->add_option("--restart", checkpoint_,
                                "Continues from a checkpoint; by default that in the results of the scene")
                   ->expected(0, 1)
                   ->type_name("CHECKPOINT");
    run_->add_flag("-q,--quiet", options_.quiet, "Prints nothing unless something is wrong");
    report_->add_option("folder", reported_, "Where a run has written its results")->required()->type_name("FOLDER");
    graph_
        ->add_option("-o,--output", picture_,
                     "A .dot or .svg file; without it the graph is printed in the dot language")
        ->type_name("PICTURE");
  }

  void declare_texts() {
    explain_->add_option("name", explained_, "As 'sprekk list' or a scene writes them, for example grow iterate")
        ->required()
        ->type_name("NAME");
    schema_->add_option("file", schema_of_, "scene or study")->check(CLI::IsMember({"scene", "study"}));
    reference_->add_option("folder", reference_folder_, "Where to")->required()->type_name("FOLDER");
    completion_->add_option("shell", shell_, "bash or zsh")->required()->check(CLI::IsMember({"bash", "zsh"}));
  }

  void declare_plugins() {
    for (CLI::App* command : {run_, check_, show_, fractures_, graph_, list_, explain_, schema_, reference_,
                              sweep_.command(), converge_.command(), schemes_.command()}) {
      command
          ->add_option("--plugin", plugins_,
                       "Loads a shared library with further components and couplers; once for each. SPREKK_PLUGINS "
                       "lists more")
          ->allow_extra_args(false)
          ->type_name("FILE");
      command
          ->add_option("--plugins", plugin_folders_,
                       "Trusts the shared libraries in a folder: those that a scene names by 'plugins' are loaded; "
                       "once for each. SPREKK_PLUGIN_FOLDERS lists more")
          ->allow_extra_args(false)
          ->type_name("FOLDER");
    }
  }

  void declare_programs() {
    for (CLI::App* command : {run_, check_, sweep_.command(), converge_.command(), schemes_.command()})
      command
          ->add_option(
              "--program", programs_,
              "Starts the program of a component outside/program: --program model='python3 model.py'; once for "
              "each. 'check' starts none")
          ->allow_extra_args(false)
          ->type_name("NAME=COMMAND");
  }

  void print_texts() const {
    if (*list_) print_list(std::cout);
    if (*explain_) print_explanations(explained_, std::cout);
    if (*schema_) schema_of_ == "study" ? print_study_schema(std::cout) : print_schema(std::cout);
    if (*manual_) std::cout << manual_page(declared_command(app_), purpose_.summary, build_info().version);
    if (*completion_)
      std::cout << (shell_ == "zsh" ? zsh_completion(declared_command(app_)) : bash_completion(declared_command(app_)));
    if (*reference_) write_reference(reference_folder_);
  }

  ExitCode run_of_user() {
    const Scene read = scene_.read();
    options_.scene_files = scene_.files;
    if (!folder_.empty()) options_.folder = folder_;
    if (restart_->count() > 0) options_.checkpoint = find_checkpoint(checkpoint_, folder_, read);
    return run_scene(read, options_);
  }

  CLI::App& app_;
  const ProgramPurpose& purpose_;
  // In the order in which they are listed.
  CLI::App* run_ = app_.add_subcommand("run", "Runs a scene");
  CLI::App* check_ = app_.add_subcommand("check", "Builds everything and solves nothing");
  SweepCommand sweep_{app_};
  NewCommand new_plugin_;
  CLI::App* report_ = app_.add_subcommand("report", "Writes report.html into a folder of results");
  CompareCommand compare_{app_};
  ConvergeCommand converge_{app_};
  SchemesCommand schemes_{app_};
  CLI::App* show_ = app_.add_subcommand("show", "Prints the scene with every default, and where each value came from");
  CLI::App* fractures_ =
      app_.add_subcommand("fractures", "Prints the fractures as a table, also those that are drawn at random");
  CLI::App* graph_ = app_.add_subcommand("graph", "Draws components, couplers and schedule");
  CLI::App* list_ = app_.add_subcommand("list", "Lists what exists");
  CLI::App* explain_ = app_.add_subcommand(
      "explain", "Explains types, steps of the schedule, sections of a scene, parameters, laws and accelerators");
  CLI::App* schema_ = app_.add_subcommand("schema", "Prints the JSON schema of scenes, or of studies");
  CLI::App* reference_ = app_.add_subcommand("reference", "Writes the reference pages");
  CLI::App* manual_ = app_.add_subcommand("man", "Prints the manual page, for man");
  CLI::App* completion_ = app_.add_subcommand("completion", "Prints a script that completes commands in a shell");

  SceneArguments scene_;
  RunOptions options_;
  CLI::Option* restart_ = nullptr;
  std::string folder_, checkpoint_, reference_folder_, picture_, reported_, schema_of_ = "scene", shell_;
  std::vector<std::string> explained_, plugins_, plugin_folders_, programs_;
};

}  // namespace

int run_command_line(int argc, char** argv, const ProgramPurpose& purpose) {
  std::signal(SIGXFSZ, SIG_IGN);  // so a limit on the size of files makes writing fail, as a full disk does
  CLI::App app(purpose.description);
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  Commands commands(app, purpose);
  try {
    require_command(app, argc, argv);
  } catch (const InputError& error) {
    return answer_wrong_input(error);
  }
  let_restart_follow_scenes(argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::wrong_input);
  }
  try {
    try {
      return static_cast<int>(commands.run());
    } catch (const OtherDimension& other) {
      hand_over(other.dimension, argv);
    }
  } catch (const InputError& error) {
    return answer_wrong_input(error);
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << "\n";
    if (parallel::size() > 1) parallel::abort_all(static_cast<int>(ExitCode::failed));
    return static_cast<int>(ExitCode::failed);
  }
}

}  // namespace sprekk
