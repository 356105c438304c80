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
#include "framework/command_line/converge_command.hpp"
#include "framework/command_line/explain_command.hpp"
#include "framework/command_line/graph_command.hpp"
#include "framework/command_line/manual_page.hpp"
#include "framework/command_line/new_command.hpp"
#include "framework/command_line/scene_arguments.hpp"
#include "framework/command_line/schemes_command.hpp"
#include "framework/command_line/sweep_command.hpp"
#include "framework/config/describe/resolved_yaml.hpp"
#include "framework/linear/linear_solver.hpp"
#include "framework/meshing/fracture_table.hpp"
#include "framework/output/activity.hpp"
#include "framework/output/build_info.hpp"
#include "framework/output/output_folder.hpp"
#include "framework/output/progress.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/plugin/plugin.hpp"
#include "framework/report/report.hpp"
#include "framework/run/note_records.hpp"
#include "framework/run/simulation.hpp"
#include "framework/run/start_notes.hpp"
#include "framework/run/stop_condition.hpp"
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

}  // namespace

int run_command_line(int argc, char** argv, const ProgramPurpose& purpose) {
  std::signal(SIGXFSZ, SIG_IGN);  // so a limit on the size of files makes writing fail, as a full disk does
  CLI::App app(purpose.description);
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);

  SceneArguments scene;
  RunOptions run;
  std::string folder, checkpoint, reference_folder, picture, reported, schema_of = "scene", shell;

  CLI::App* run_command = app.add_subcommand("run", "Runs a scene");
  scene.add_to(*run_command);
  run_command->add_option("-o,--output", folder, "Folder for the results; results/<scene> by default")
      ->type_name("FOLDER");
  CLI::Option* restart = run_command
                             ->add_option("--restart", checkpoint,
                                          "Continues from a checkpoint; by default that in the results of the scene")
                             ->expected(0, 1)
                             ->type_name("CHECKPOINT");
  run_command->add_flag("-q,--quiet", run.quiet, "Prints nothing unless something is wrong");
  CLI::App* check_command = app.add_subcommand("check", "Builds everything and solves nothing");
  scene.add_to(*check_command);
  SweepCommand sweep(app);
  NewCommand new_plugin(app, purpose.templates);
  CLI::App* report_command = app.add_subcommand("report", "Writes report.html into a folder of results");
  report_command->add_option("folder", reported, "Where a run has written its results")
      ->required()
      ->type_name("FOLDER");
  CompareCommand compare(app);
  ConvergeCommand converge(app);
  SchemesCommand schemes(app);
  CLI::App* show_command =
      app.add_subcommand("show", "Prints the scene with every default, and where each value came from");
  scene.add_to(*show_command);
  CLI::App* fractures_command =
      app.add_subcommand("fractures", "Prints the fractures as a table, also those that are drawn at random");
  scene.add_to(*fractures_command);
  CLI::App* graph_command = app.add_subcommand("graph", "Draws components, couplers and schedule");
  scene.add_to(*graph_command);
  graph_command
      ->add_option("-o,--output", picture, "A .dot or .svg file; without it the graph is printed in the dot language")
      ->type_name("PICTURE");
  CLI::App* list_command = app.add_subcommand("list", "Lists what exists");
  CLI::App* explain_command = app.add_subcommand(
      "explain", "Explains types, steps of the schedule, sections of a scene, parameters, laws and accelerators");
  std::vector<std::string> explained;
  explain_command->add_option("name", explained, "As 'sprekk list' or a scene writes them, for example grow iterate")
      ->required()
      ->type_name("NAME");
  CLI::App* schema_command = app.add_subcommand("schema", "Prints the JSON schema of scenes, or of studies");
  schema_command->add_option("file", schema_of, "scene or study")->check(CLI::IsMember({"scene", "study"}));
  CLI::App* reference_command = app.add_subcommand("reference", "Writes the reference pages");
  reference_command->add_option("folder", reference_folder, "Where to")->required()->type_name("FOLDER");
  CLI::App* manual_command = app.add_subcommand("man", "Prints the manual page, for man");
  CLI::App* completion_command = app.add_subcommand("completion", "Prints a script that completes commands in a shell");
  std::vector<std::string> plugins, plugin_folders;
  for (CLI::App* command :
       {run_command, check_command, show_command, fractures_command, graph_command, list_command, explain_command,
        schema_command, reference_command, sweep.command(), converge.command(), schemes.command()}) {
    command
        ->add_option("--plugin", plugins,
                     "Loads a shared library with further components and couplers; once for each. SPREKK_PLUGINS lists "
                     "more")
        ->allow_extra_args(false)
        ->type_name("FILE");
    command
        ->add_option("--plugins", plugin_folders,
                     "Trusts the shared libraries in a folder: those that a scene names by 'plugins' are loaded; once "
                     "for each. SPREKK_PLUGIN_FOLDERS lists more")
        ->allow_extra_args(false)
        ->type_name("FOLDER");
  }
  completion_command->add_option("shell", shell, "bash or zsh")->required()->check(CLI::IsMember({"bash", "zsh"}));

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
    take_plugins_of_environment();
    for (const std::string& file : plugins) load_plugin_of_user(file, {"--plugin"});
    for (const std::string& folder : plugin_folders) trust_plugins_in(folder, {"--plugins"});
    if (*list_command) print_list(std::cout);
    if (*explain_command) print_explanations(explained, std::cout);
    if (*schema_command) schema_of == "study" ? print_study_schema(std::cout) : print_schema(std::cout);
    if (*manual_command) std::cout << manual_page(declared_command(app), purpose.summary, build_info().version);
    if (*completion_command)
      std::cout << (shell == "zsh" ? zsh_completion(declared_command(app)) : bash_completion(declared_command(app)));
    if (*reference_command) write_reference(reference_folder);
    if (*show_command) print_scene(scene.read());
    if (*fractures_command) std::cout << fracture_table(scene.read().geometry.fractures);
    if (*graph_command) draw_graph(Model(scene.read()), picture);
    if (*check_command) check_scene(scene.read());
    if (*report_command) std::cout << "report: " << write_report(reported).string() << "\n";
    if (new_plugin.is_called()) new_plugin.run();

    if (compare.is_called()) return static_cast<int>(compare.run());
    if (converge.is_called()) return static_cast<int>(converge.run());
    if (schemes.is_called()) return static_cast<int>(schemes.run());
    if (sweep.is_called()) return static_cast<int>(sweep.run());
    if (*run_command) {
      const Scene read = scene.read();
      run.scene_files = scene.files;
      if (!folder.empty()) run.folder = folder;
      if (restart->count() > 0) run.checkpoint = find_checkpoint(checkpoint, folder, read);
      return static_cast<int>(run_scene(read, run));
    }
    return 0;
  } catch (const InputError& error) {
    return answer_wrong_input(error);
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << "\n";
    if (parallel::size() > 1) parallel::abort_all(static_cast<int>(ExitCode::failed));
    return static_cast<int>(ExitCode::failed);
  }
}

}  // namespace sprekk
