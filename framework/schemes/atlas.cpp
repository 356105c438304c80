#include "framework/schemes/atlas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <utility>

#include "framework/compare/run_difference.hpp"
#include "framework/config/input_error.hpp"
#include "framework/config/yaml/load_scene.hpp"
#include "framework/config/yaml/settings.hpp"
#include "framework/output/atomic_file.hpp"
#include "framework/picture/text_table.hpp"
#include "framework/schemes/atlas_page.hpp"
#include "framework/schemes/atlas_tables.hpp"
#include "framework/schemes/factor_curves.hpp"
#include "framework/schemes/pass_factor.hpp"
#include "framework/schemes/scheme_result.hpp"
#include "framework/study/run_state.hpp"
#include "framework/study/sweep.hpp"

namespace sprekk {
namespace {

namespace fs = std::filesystem;

using Settings = std::vector<std::pair<std::string, std::string>>;  // path, value

std::string yaml_quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

std::pair<std::string, std::string> split_setting(const std::string& setting, const std::string& option) {
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos || equals == 0)
    throw InputError({option + " " + setting}, "this gives no value", "it is a path and values",
                     "write for example " + option + " time.step=1h,2h");
  return {setting.substr(0, equals), setting.substr(equals + 1)};
}

/// "path=a,b,c": values are separated by commas outside of brackets.
std::pair<std::string, std::vector<std::string>> axis_of(const std::string& text) {
  const auto [path, list] = split_setting(text, "--over");
  std::vector<std::string> values(1);
  int depth = 0;
  for (const char c : list) {
    depth += (c == '[' || c == '{') - (c == ']' || c == '}');
    if (c == ',' && depth == 0)
      values.emplace_back();
    else
      values.back() += c;
  }
  if (std::ranges::any_of(values, [](const std::string& value) { return value.empty(); }))
    throw InputError({"--over " + text}, "a value is missing", "values are separated by commas", "write path=a,b,c");
  return {path, values};
}

/// One call of `sprekk schemes`.
class Atlas {
 public:
  explicit Atlas(const AtlasOptions& options);
  ExitCode execute();

 private:
  struct Run {
    std::string name;
    std::size_t scheme;
    Settings settings;
  };
  std::vector<Run> planned() const;
  fs::path write_study(const std::vector<Run>& runs) const;
  SchemeResult result(const Run& run) const;
  std::vector<std::optional<double>> predicted(const Settings& values) const;
  void write() const;

  const AtlasOptions& options_;
  Scene scene_;
  fs::path folder_;
  std::vector<Scheme> schemes_;
  std::vector<std::string> behind_;  // the scene's steps of growth, which follow those of a scheme
  std::vector<std::pair<std::string, std::vector<std::string>>> axes_;
  std::vector<SchemeResult> results_;
  std::vector<AtlasMap> maps_;
};

Scene read(const AtlasOptions& options) {
  const fs::path first = options.scene_files.front();
  return read_scene(load_scene(options.scene_files, overrides_of(options.settings)),
                    first.parent_path().empty() ? "." : first.parent_path().string(), first.stem().string());
}

Atlas::Atlas(const AtlasOptions& options)
    : options_(options),
      scene_(read(options)),
      folder_(options.folder.value_or(fs::path("results") / (scene_.name + "_schemes"))) {
  static const std::vector<std::string> usual = {"", "aitken: {}", "anderson: 5", "iqn_ils: {}", "iqn_imvj: {}"};
  std::vector<std::string> accelerations = usual;
  if (!options.accelerations.empty()) {
    accelerations = {""};
    for (const std::string& acceleration : options.accelerations)
      if (acceleration != "none" && std::ranges::count(accelerations, acceleration) == 0)
        accelerations.push_back(acceleration);
  }
  for (const std::string& over : options.over) axes_.push_back(axis_of(over));
  if (axes_.size() > 2)
    throw InputError({"--over " + options.over[2]}, "a map has two axes", "this is a third one", "remove one");
  const Node& schedule = *scene_.whole.find("schedule");
  for (const Node& step : schedule.items)
    if (step.find("grow")) behind_.push_back(step.text());
  Model model(scene_);
  schemes_ = sensible_schemes(model, accelerations);
  if (schemes_.size() < 2)
    throw InputError({options.scene_files.front()}, "there is one scheme only",
                     "the scene has no components that could be solved apart", "choose a scene with two or more");
  if (options.only.empty()) return;
  const std::vector<Scheme> all = std::exchange(schemes_, {});
  for (const Scheme& scheme : all)
    if (scheme.is_monolithic() ||
        std::ranges::any_of(options.only, [&](const std::string& text) { return scheme.is_called(text); }))
      schemes_.push_back(scheme);
  if (schemes_.size() > 1) return;
  std::vector<std::string> names;
  for (const Scheme& scheme : all) names.push_back(scheme.name());
  throw unknown_name({"--only " + options.only.front()}, "scheme", options.only.front(), names);
}

std::vector<Atlas::Run> Atlas::planned() const {
  std::vector<Run> runs;
  for (std::size_t s = 0; s < schemes_.size(); ++s) runs.push_back({schemes_[s].name(), s, {}});
  if (axes_.empty()) return runs;
  const std::vector<std::string> one = {""};
  const std::vector<std::string>& second = axes_.size() > 1 ? axes_[1].second : one;
  for (std::size_t s = 0; s < schemes_.size(); ++s)
    for (std::size_t j = 0; j < second.size(); ++j)
      for (std::size_t i = 0; i < axes_[0].second.size(); ++i) {
        Settings settings = {{axes_[0].first, axes_[0].second[i]}};
        if (axes_.size() > 1) settings.emplace_back(axes_[1].first, second[j]);
        runs.push_back({fmt::format("{}-at_{}_{}", schemes_[s].name(), i, j), s, settings});
      }
  return runs;
}

fs::path Atlas::write_study(const std::vector<Run>& runs) const {
  const TimeOptions& time = scene_.time;
  // No step is cut: a scheme that needs that does not converge, and another step would have another answer.
  std::string text =
      "# Written by sprekk schemes; sprekk sweep runs it, too.\nname: " + yaml_quoted(folder_.filename().string()) +
      "\nscene: [";
  for (std::size_t i = 0; i < options_.scene_files.size(); ++i)
    text += (i > 0 ? ", " : "") + yaml_quoted(fs::absolute(options_.scene_files[i]).string());
  text += "]\nset:\n";
  for (const std::string& setting : options_.settings) {
    const auto [path, value] = split_setting(setting, "--set");
    if (path == "time.end" || path == "time.smallest") continue;  // the scene has them, and they follow below
    text += "  " + yaml_quoted(path) + ": " + value + "\n";
  }
  text += fmt::format("  time.end: {:.17g} s\n  time.smallest: {:.17g} s\nruns:\n",
                      std::min(time.end, time.start + options_.steps * time.step), time.step);
  for (const Run& run : runs) {
    text += "  " + yaml_quoted(run.name) +
            ":\n    schedule: " + schemes_[run.scheme].schedule(options_.until, options_.at_most, behind_) + "\n";
    for (const auto& [path, value] : run.settings) text += "    " + yaml_quoted(path) + ": " + value + "\n";
  }
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error || !fs::is_directory(folder_))
    throw InputError("the folder " + folder_.string() + " cannot be made choose another one with -o");
  const fs::path file = folder_ / "schemes.yaml";
  write_atomically(file, text);
  return file;
}

/// "[Pa]" of "pore.pressure[Pa]".
std::string unit_of(const std::string& array) {
  const std::size_t begin = array.rfind('[');
  return begin == std::string::npos ? "" : array.substr(begin);
}

/// The mean factor of the last changes by passes in the first step, before these are round-off.
std::optional<double> measured_factor(const CsvTable& coupling) {
  constexpr double round_off = 1e-11;  // of scaled fields
  constexpr std::size_t counted = 4;   // of which the factor is the mean
  const std::vector<std::string> steps = coupling.texts(coupling.find("schedule"));
  const std::vector<double> passes = coupling.numbers("iteration"), changes = coupling.numbers("update");
  std::vector<double> sizes;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (steps[i] != "iterate") continue;
    if (passes[i] == 1 && !sizes.empty()) break;
    if (passes[i] > 1 && changes[i] > round_off) sizes.push_back(changes[i]);
  }
  if (sizes.size() < 2) return std::nullopt;
  const std::size_t ratios = std::min(counted, sizes.size() - 1);
  return std::pow(sizes.back() / sizes[sizes.size() - 1 - ratios], 1.0 / static_cast<double>(ratios));
}

/// The largest absolute value of the last written fields, by unit: "[Pa]".
std::map<std::string, double> sizes_of_fields(const ComparedRun& run) {
  std::map<std::string, double> sizes;
  for (const auto* snapshots : {&run.matrix, &run.fractures}) {
    if (snapshots->empty()) continue;
    for (const Grid::Values& array : read_grid(snapshots->back().file).arrays) {
      double& size = sizes[unit_of(array.name)];
      for (const double value : array.values) size = std::max(size, std::abs(value));
    }
  }
  return sizes;
}

/// The largest difference of any field from the monolithic answer. Fields of one unit share a scale: where a jump is
/// zero, its size is that of displacements.
std::optional<double> difference_of_fields(const fs::path& reference, const fs::path& run) {
  const ComparedRun right = read_compared_run(reference), ours = read_compared_run(run);
  const RunDifference difference = run_difference(right, ours, {});
  if (!difference.written) return std::nullopt;
  const std::map<std::string, double> sizes = sizes_of_fields(right);
  double largest = 0;
  for (const GridDifference* grid : {&difference.matrix, &difference.fractures})
    for (const FieldDifference& field : grid->fields) {
      const auto size = sizes.find(unit_of(field.array));
      if (size != sizes.end() && size->second > 0) largest = std::max(largest, field.largest / size->second);
    }
  return largest;
}

SchemeResult Atlas::result(const Run& run) const {
  SchemeResult result;
  result.scheme = schemes_[run.scheme];
  result.run = run.name;
  const std::map<std::string, RunState> states = read_states(folder_);
  const RunState& state = states.at(run.name);
  result.is_done = state.status == RunState::Status::done;
  result.reason = state.reason;
  const fs::path folder = folder_ / run.name;
  for (const double value : CsvTable::read(folder / "history.csv").numbers("iterations"))
    if (std::isfinite(value)) result.passes.push_back(static_cast<int>(value));
  if (fs::exists(folder / "run.json")) result.processor = read_compared_run(folder).cost.processor;
  if (!result.scheme.is_monolithic()) result.measured = measured_factor(CsvTable::read(folder / "coupling.csv"));
  const std::string at = run.settings.empty() ? "" : run.name.substr(run.name.rfind("-at_"));
  const std::string monolithic = schemes_.front().name() + at;
  if (result.is_done && states.contains(monolithic) && states.at(monolithic).status == RunState::Status::done)
    result.difference = difference_of_fields(folder_ / monolithic, folder);
  return result;
}

/// The factor of a pass of each scheme without acceleration, from the equations of the first step, where the monolithic
/// scheme has ended it. `values`: of the scene, beside its settings.
std::vector<std::optional<double>> Atlas::predicted(const Settings& values) const {
  std::vector<std::optional<double>> factors(schemes_.size());
  std::vector<Override> overrides = overrides_of(options_.settings);
  for (const auto& [path, value] : values) overrides.push_back({path, value});
  overrides.push_back({"schedule", schemes_.front().schedule(options_.until, options_.at_most, {})});
  const fs::path first = options_.scene_files.front();
  const Scene scene =
      read_scene(load_scene(options_.scene_files, overrides),
                 first.parent_path().empty() ? "." : first.parent_path().string(), first.stem().string());
  Model model(scene);
  const StepTime step{scene.time.start, scene.time.step, scene.time.start + scene.time.step};
  if (!model.attempt(step).converged) return factors;
  PassFactor factor(model, step);
  for (std::size_t s = 0; s < schemes_.size(); ++s)
    if (schemes_[s].acceleration.empty() && !schemes_[s].is_monolithic()) factors[s] = factor.of(schemes_[s]);
  return factors;
}

void Atlas::write() const {
  write_atomically(folder_ / "schemes.csv", atlas_csv(results_, maps_));
  write_atomically(folder_ / "schemes.json", atlas_json(results_, maps_));
  write_atomically(folder_ / "schemes.html", atlas_page(scene_.name, results_, maps_));
  if (!maps_.empty()) write_atomically(folder_ / "schemes.svg", factors_svg(maps_));
}

ExitCode Atlas::execute() {
  const std::vector<Run> runs = planned();
  const Study study = read_study(write_study(runs).string());
  SweepOptions sweep;
  sweep.folder = folder_;
  sweep.processes = options_.processes;
  sweep.quiet = options_.is_quiet;
  sweep.has_table = sweep.tells_failures = false;
  if (const ExitCode code = run_sweep(study, sweep); code == ExitCode::interrupted) return code;
  std::map<Settings, std::vector<std::optional<double>>> predictions;
  for (const Run& run : runs) {
    SchemeResult found = result(run);
    if (!predictions.contains(run.settings)) predictions[run.settings] = predicted(run.settings);
    found.predicted = predictions[run.settings][run.scheme];
    if (run.settings.empty()) {
      results_.push_back(std::move(found));
      continue;
    }
    const std::string name = schemes_[run.scheme].name();
    if (maps_.empty() || maps_.back().scheme != name) maps_.push_back({name, axes_, {}});
    maps_.back().results.push_back(std::move(found));
  }
  write();
  if (!options_.is_quiet)
    std::cout << text_table(result_rows(results_)) << (maps_.empty() ? "" : text_table(optimum_rows(maps_)))
              << "page: " << (folder_ / "schemes.html").string() << "\n";
  if (results_.front().is_done) return ExitCode::done;
  std::cerr << "the monolithic scheme did not converge: " << results_.front().reason << "\n";
  return ExitCode::failed;
}

}  // namespace

ExitCode run_atlas(const AtlasOptions& options) { return Atlas(options).execute(); }

}  // namespace sprekk
