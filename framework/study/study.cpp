#include "framework/study/study.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>

#include "framework/config/node_paths.hpp"
#include "framework/config/text_file.hpp"
#include "framework/config/unknown_key.hpp"
#include "framework/config/yaml/load_scene.hpp"
#include "framework/config/yaml/parse_yaml.hpp"
#include "framework/scene/key_places.hpp"
#include "framework/study/scene_identity.hpp"

namespace sprekk {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t most_runs = 10'000;  // more are a mistake
constexpr std::size_t longest_name = 100;  // letters of a run's folder

/// The text without blanks, and without letters that names of folders should not have.
std::string folder_text(const std::string& text) {
  std::string result;
  for (const unsigned char c : text) {
    if (std::isspace(c) || c == '"' || c == '\'') continue;
    const bool is_kept = c >= 128 || std::isalnum(c) || std::string("._-+^%").find(char(c)) != std::string::npos;
    result += is_kept ? char(c) : '_';
  }
  return result;
}

std::string last_part(const std::string& path) { return path.substr(path.rfind('.') + 1); }

/// One of the values that runs are combined of: "step=1h", and what it sets.
struct Level {
  std::string name;
  std::vector<Setting> settings;
  std::string choice, option;  ///< of a choice
  bool is_sample = false;
};
using Factor = std::vector<Level>;

/// The last part of a path, or the whole path where something else has that name.
std::string short_name(const StudyOptions& options, const std::string& path) {
  const auto same = std::ranges::count_if(
      options.grid, [&](const StudyOptions::Axis& axis) { return last_part(axis.path) == last_part(path); });
  const bool is_choice =
      std::ranges::any_of(options.choices, [&](const auto& choice) { return choice.name == last_part(path); });
  return same == 1 && !is_choice ? last_part(path) : path;
}

std::vector<Factor> factors(const StudyOptions& options) {
  std::vector<Factor> factors;
  for (const StudyOptions::Choice& choice : options.choices) {
    factors.emplace_back();
    for (const StudyOptions::Choice::Option& option : choice.options)
      factors.back().push_back({choice.name + "=" + option.name, option.settings, choice.name, option.name});
  }
  for (const StudyOptions::Axis& axis : options.grid) {
    factors.emplace_back();
    for (const Setting& value : axis.values)
      factors.back().push_back({short_name(options, axis.path) + "=" + folder_text(value.value), {value}, "", ""});
  }
  if (!options.samples.is_given) return factors;
  factors.emplace_back();
  const std::vector<std::vector<std::string>> samples = options.samples.draw();
  const std::size_t digits = std::to_string(samples.size()).size();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    Level level{"sample=" + std::string(digits - number.size(), '0') + number, {}, "", "", true};
    auto value = samples[i].begin();
    for (const DistributionOptions& distribution : options.samples.of)
      level.settings.push_back({distribution.path, *value++, distribution.origin, distribution.origin});
    factors.back().push_back(level);
  }
  return factors;
}

/// "step=1h,fracture_size=10mm", cut where it is too long for the name of a folder.
std::string short_enough(const std::string& name) {
  return name.size() <= longest_name ? name : name.substr(0, longest_name - 17) + "-" + text_identity(name);
}

/// A run for each combination.
std::vector<StudyRun> combined_runs(const StudyOptions& options) {
  std::vector<StudyRun> runs;
  const std::vector<Factor> all = factors(options);
  if (!all.empty()) runs.emplace_back();
  for (const Factor& factor : all) {
    std::vector<StudyRun> longer;
    if (runs.size() * factor.size() > most_runs)
      throw InputError(factor.front().settings.empty() ? Origin{} : factor.front().settings.front().key_origin,
                       "the study has too many runs", "more than " + std::to_string(most_runs), "shorten its lists");
    for (const StudyRun& run : runs)
      for (const Level& level : factor) {
        StudyRun next = run;
        if (level.is_sample) next.samples_of = run.name.empty() ? "all" : run.name;
        next.name += (run.name.empty() ? "" : ",") + level.name;
        next.settings.insert(next.settings.end(), level.settings.begin(), level.settings.end());
        if (!level.choice.empty()) next.chosen[level.choice] = level.option;
        longer.push_back(std::move(next));
      }
    runs = std::move(longer);
  }
  for (StudyRun& run : runs) run.name = short_enough(run.name);
  return runs;
}

void check_names_differ(const std::vector<StudyRun>& runs) {
  std::set<std::string> names;
  for (const StudyRun& run : runs)
    if (!names.insert(run.name).second)
      throw InputError(run.settings.empty() ? Origin{} : run.settings.back().value_origin,
                       "two runs would be called " + quoted(run.name), "their values differ too little",
                       "name them in 'runs:'");
}

/// Refuses names that cannot be those of a folder in results/.
void check_study_name(const std::string& name, const Origin& origin) {
  const bool has_control = std::any_of(name.begin(), name.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; });
  if (name.empty() || name[0] == '.' || name.find('/') != std::string::npos || has_control)
    throw InputError(origin, "a study cannot be called " + quoted(name),
                     "its name is that of a folder in results/, without '/' and without '.' in front",
                     "choose another name");
}

std::vector<std::string> varied_keys(const StudyOptions& options) {
  std::vector<std::string> keys;
  const auto add = [&](const std::string& path) {
    if (std::find(keys.begin(), keys.end(), path) == keys.end()) keys.push_back(path);
  };
  for (const StudyOptions::Choice& choice : options.choices) add(choice.name);
  for (const StudyOptions::Axis& axis : options.grid) add(axis.path);
  if (options.samples.is_given)
    for (const DistributionOptions& distribution : options.samples.of) add(distribution.path);
  for (const StudyOptions::NamedRun& run : options.runs)
    for (const Setting& setting : run.settings) add(setting.path);
  return keys;
}

/// The value of a parameter in a scene, given or by default.
std::string value_of(const Scene& scene, const std::string& path) {
  for (const Scene::Resolved& value : scene.resolved)
    if (value.path == path) return value.value;
  const Node* node = &scene.whole;
  for (std::string rest = path; node && !rest.empty();) {
    const std::size_t dot = rest.find('.');
    node = node->find(rest.substr(0, dot));
    rest = dot == std::string::npos ? "" : rest.substr(dot + 1);
  }
  return node ? node->text() : "";
}

std::vector<std::string> scene_files(const StudyOptions& options, const fs::path& folder) {
  std::vector<std::string> files;
  for (const std::string& file : options.scene) {
    const fs::path path = (folder / file).lexically_normal();
    if (!fs::is_regular_file(path))
      throw InputError(options.scene_origin, "there is no scene " + quoted(file), "looked for is " + path.string(),
                       "paths are relative to the file of the study");
    files.push_back(path.string());
  }
  if (files.empty()) throw InputError(options.scene_origin, "the study names no scene", "", "write 'scene: a.yaml'");
  return files;
}

/// Reads the scene of every run, and reports the mistakes of all, each once.
void read_scenes(Study& study) {
  std::vector<std::string> problems;
  for (StudyRun& run : study.runs) {
    try {
      const Scene scene = study.scene_of(run);
      for (const std::string& key : study.keys) {
        const auto option = run.chosen.find(key);
        run.values.push_back(option != run.chosen.end() ? option->second : value_of(scene, key));
      }
      run.identity = scene_identity(scene.whole, fs::path(study.scene_files.front()).parent_path());
    } catch (const InputError& error) {
      for (const std::string& problem : error.problems())
        if (std::find(problems.begin(), problems.end(), problem) == problems.end()) problems.push_back(problem);
    }
  }
  if (!problems.empty()) throw InputError(problems);
}

}  // namespace

Scene Study::scene_of(const StudyRun& run) const {
  std::vector<Override> overrides;
  for (const Setting& setting : run.settings)
    overrides.push_back({setting.path, setting.value, setting.key_origin, setting.value_origin});
  const std::string folder = fs::path(scene_files.front()).parent_path().string();
  return read_scene(load_scene(scene_files, overrides), folder.empty() ? "." : folder,
                    fs::path(scene_files.front()).stem().string());
}

Study read_study(const std::string& file) {
  Node whole = parse_yaml(read_text_file(file, file), file);
  set_paths(whole, "study");
  if (const Node* launcher = whole.find("launcher"))
    throw InputError(launcher->origin, "a study names no launcher",
                     "a launcher is a command, and a file may come from anybody",
                     "call 'sprekk sweep " + file + " --launcher COMMAND'");
  StudyOptions options;
  const KnownPlaces places([](const std::string& key) { return KeyPlaces(study_spec()).text(key); });
  options.spec().read(whole, {});

  Study study;
  study.name = options.name.value_or(fs::path(file).stem().string());
  check_study_name(study.name, options.name ? whole.find("name")->origin : Origin{file});
  study.scene_files = scene_files(options, fs::path(file).parent_path());
  study.keys = varied_keys(options);
  study.runs = combined_runs(options);
  study.has_samples = options.samples.is_given;
  for (const StudyOptions::NamedRun& run : options.runs) study.runs.push_back({run.name, run.settings, {}, ""});
  check_names_differ(study.runs);
  for (StudyRun& run : study.runs) run.settings.insert(run.settings.begin(), options.set.begin(), options.set.end());
  study.plot = options.plot;
  study.plot_origin = options.plot_origin;
  study.table = options.table;
  study.reference = options.reference;
  if (study.reference) {
    std::vector<std::string> names;
    for (const StudyRun& run : study.runs) names.push_back(run.name);
    if (std::find(names.begin(), names.end(), *study.reference) == names.end())
      throw unknown_name(options.reference_origin, "run", *study.reference, names);
  }
  read_scenes(study);
  return study;
}

}  // namespace sprekk
