#include "framework/converge/convergence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "framework/compare/compared_run.hpp"
#include "framework/config/input_error.hpp"
#include "framework/config/yaml/load_scene.hpp"
#include "framework/config/yaml/settings.hpp"
#include "framework/converge/cheapest.hpp"
#include "framework/converge/error_estimate.hpp"
#include "framework/converge/refinement.hpp"
#include "framework/output/atomic_file.hpp"
#include "framework/output/progress.hpp"
#include "framework/picture/display_unit.hpp"
#include "framework/picture/text_table.hpp"
#include "framework/study/sweep.hpp"

namespace sprekk {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

const std::string middle = "middle", all_fine = "all_fine", chosen = "chosen";
constexpr int digits = 5;

std::string yaml_quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

/// How a figure is taken: "slip.t@6 h" at a time, "slip.t@largest" over all times, "slip.t" at the end.
std::string figure_yaml(const std::string& quantity) {
  const std::size_t mark = quantity.rfind('@');
  const std::string of = quantity.substr(0, mark), how = mark == std::string::npos ? "end" : quantity.substr(mark + 1);
  static const std::vector<std::string> taken = {"largest", "smallest", "farthest_from_zero", "mean", "integral"};
  const bool is_taken = std::find(taken.begin(), taken.end(), how) != taken.end();
  return "{of: " + yaml_quoted(of) + (is_taken ? ", take: " : ", at: ") + yaml_quoted(how) + "}";
}

std::string run_name(const Refinement& refinement, const char* level) {
  std::string name;
  for (const char c : refinement.name) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name + "_" + level;
}

/// The wanted error of a value: "1%" or "0.01" of it, or an amount in its unit.
double wanted_error(const std::string& to, double value) {
  char* end = nullptr;
  const double number = std::strtod(to.c_str(), &end);
  const std::string rest = end;
  if (end == to.c_str() || !(number > 0) || (!rest.empty() && rest != "%" && rest != " %"))
    throw InputError({"--to " + to}, "this is no error that could be reached", "it is a share of the value",
                     "write for example --to 1%");
  return (rest.empty() ? number : number / 100) * std::abs(value);
}

/// One call of `sprekk converge`.
class Convergence {
 public:
  explicit Convergence(const ConvergenceOptions& options);
  ExitCode execute();

 private:
  using Factors = std::vector<double>;
  std::vector<std::pair<std::string, Factors>> levels() const;
  fs::path write_study(const std::vector<std::pair<std::string, Factors>>& runs, const fs::path& folder) const;
  ExitCode sweep(const std::vector<std::pair<std::string, Factors>>& runs, const fs::path& folder);
  double figure(const FigureOptions& figure, const fs::path& run) const;
  void estimate();
  std::string table() const;
  std::string setting_text(const Factors& factors) const;
  Json record() const;
  ExitCode reach();
  double middle_factor() const { return options_.coarsest / 2; }

  const ConvergenceOptions& options_;
  fs::path folder_;
  std::string name_;
  std::vector<Refinement> refinements_;
  std::optional<Study> study_;
  std::vector<ValueError> errors_;  // of the figures of the study
  std::vector<std::string> units_;
  Json reached_;
};

Convergence::Convergence(const ConvergenceOptions& options) : options_(options) {
  if (!options.to.empty()) wanted_error(options.to, 1);
  const fs::path first = options.scene_files.front();
  const Scene scene =
      read_scene(load_scene(options.scene_files, overrides_of(options.settings)),
                 first.parent_path().empty() ? "." : first.parent_path().string(), first.stem().string());
  name_ = scene.name + "_converge";
  folder_ = options.folder.value_or(fs::path("results") / name_);
  refinements_ = refinements(scene, options.refine);
}

std::vector<std::pair<std::string, Convergence::Factors>> Convergence::levels() const {
  const Factors base(refinements_.size(), middle_factor());
  std::vector<std::pair<std::string, Factors>> runs = {{middle, base}};
  for (std::size_t i = 0; i < base.size(); ++i)
    for (const auto& [level, share] : {std::pair{"coarse", 2.0}, std::pair{"fine", 0.5}}) {
      runs.emplace_back(run_name(refinements_[i], level), base);
      runs.back().second[i] *= share;
    }
  if (base.size() > 1) runs.emplace_back(all_fine, Factors(base.size(), middle_factor() / 2));
  return runs;
}

fs::path Convergence::write_study(const std::vector<std::pair<std::string, Factors>>& runs,
                                  const fs::path& folder) const {
  std::string text =
      "# Written by sprekk converge; sprekk sweep runs it, too.\nname: " + yaml_quoted(name_) + "\nscene: [";
  for (std::size_t i = 0; i < options_.scene_files.size(); ++i)
    text += (i > 0 ? ", " : "") + yaml_quoted(fs::absolute(options_.scene_files[i]).string());
  text += "]\nset:\n  - output.fields: false\n";
  for (const std::string& setting : options_.settings) {
    const std::size_t equals = setting.find('=');
    text += "  - " + yaml_quoted(setting.substr(0, equals)) + ": " + setting.substr(equals + 1) + "\n";
  }
  text += "runs:\n";
  for (const auto& [name, factors] : runs) {
    text += "  " + name + ":\n";
    for (std::size_t i = 0; i < factors.size(); ++i)
      for (const auto& [path, value] : refinements_[i].at(factors[i])) text += "    " + path + ": " + value + "\n";
  }
  text += "compare:\n  plot: [";
  std::vector<std::string> columns;
  for (const std::string& quantity : options_.quantities) {
    const std::string column = quantity.substr(0, quantity.rfind('@'));
    if (std::find(columns.begin(), columns.end(), column) == columns.end()) columns.push_back(column);
  }
  for (std::size_t i = 0; i < columns.size(); ++i) text += (i > 0 ? ", " : "") + yaml_quoted(columns[i]);
  text += "]\n  table:\n";
  for (const std::string& quantity : options_.quantities)
    text += "    " + yaml_quoted(quantity) + ": " + figure_yaml(quantity) + "\n";
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder))
    throw InputError("the folder " + folder.string() + " cannot be made choose another one with -o");
  const fs::path file = folder / "converge.yaml";
  write_atomically(file, text);
  return file;
}

ExitCode Convergence::sweep(const std::vector<std::pair<std::string, Factors>>& runs, const fs::path& folder) {
  study_ = read_study(write_study(runs, folder).string());
  SweepOptions options;
  options.folder = folder;
  options.processes = options_.processes;
  options.quiet = options_.is_quiet;
  options.has_table = false;
  return run_sweep(*study_, options);
}

double Convergence::figure(const FigureOptions& figure, const fs::path& run) const {
  const CsvTable history = CsvTable::read(folder_ / run / "history.csv");
  const double value = Figure(figure, history.columns()).of(history);
  if (!std::isfinite(value))
    throw InputError({quoted(figure.name)}, "the run " + run.string() + " has no such value",
                     "its history ends before, or its column is empty", "choose another time or quantity");
  return value;
}

void Convergence::estimate() {
  for (const FigureOptions& options : study_->table) {
    std::vector<double> coarse, fine;
    for (const Refinement& refinement : refinements_) {
      coarse.push_back(figure(options, run_name(refinement, "coarse")));
      fine.push_back(figure(options, run_name(refinement, "fine")));
    }
    const double at_middle = figure(options, middle);
    errors_.push_back(value_error(coarse, fine, at_middle, fine.size() > 1 ? figure(options, all_fine) : fine[0]));
    const CsvTable history = CsvTable::read(folder_ / middle / "history.csv");
    units_.push_back(Figure(options, history.columns()).unit());
  }
}

std::string Convergence::table() const {
  const Factors fine(refinements_.size(), 0.5), given(refinements_.size(), 1 / middle_factor());
  std::vector<std::vector<std::string>> rows = {{"quantity", "value", "± error", "of it", "extrapolated", "as given"}};
  for (const Refinement& refinement : refinements_) rows[0].push_back("by " + refinement.name);
  std::size_t i = 0;
  for (const FigureOptions& options : study_->table) {
    const ValueError& error = errors_[i];
    const double stated = error.stated(fine), size = std::abs(error.value);
    const auto share = [&](double of) { return size > 0 ? fmt::format("{:.2g} %", 100 * of / size) : "–"; };
    rows.push_back({options.name, display_text(error.value, units_[i], digits), display_text(stated, units_[i], 2),
                    share(stated), display_text(error.extrapolated, units_[i], digits),
                    "± " + share(error.stated(given))});
    for (std::size_t k = 0; k < refinements_.size(); ++k) {
      const ParameterError& one = error.parameters[k];
      rows.back().push_back(
          one.is_zero ? "0"
                      : fmt::format("{:.0f} %, {}", 100 * error.share(k),
                                    one.is_regular ? fmt::format("order {:.1f}", one.order) : std::string("no order")));
    }
    ++i;
  }
  return text_table(rows);
}

std::string Convergence::setting_text(const Factors& factors) const {
  std::string text;
  for (std::size_t i = 0; i < factors.size(); ++i)
    for (const auto& [path, value] : refinements_[i].at(factors[i] * middle_factor()))
      text += (text.empty() ? "" : ", ") + path + ": " + value;
  return text;
}

Json Convergence::record() const {
  const Factors fine(refinements_.size(), 0.5);
  Json quantities = Json::array();
  std::size_t i = 0;
  for (const FigureOptions& options : study_->table) {
    const ValueError& error = errors_[i];
    Json parameters = Json::array();
    for (std::size_t k = 0; k < refinements_.size(); ++k)
      parameters.push_back({{"name", refinements_[k].name},
                            {"error", error.parameters[k].error},
                            {"share", error.share(k)},
                            {"order", error.parameters[k].order},
                            {"regular", error.parameters[k].is_regular}});
    quantities.push_back({{"quantity", options.name},
                          {"unit", units_[i++]},
                          {"value", error.value},
                          {"error", error.stated(fine)},
                          {"extrapolated", error.extrapolated},
                          {"mixed", error.mixed},
                          {"parameters", parameters}});
  }
  Json whole = {{"quantities", quantities}};
  if (!reached_.is_null()) whole["chosen"] = reached_;
  return whole;
}

ExitCode Convergence::reach() {
  CostModel cost;
  const double at_middle = read_compared_run(folder_ / middle).cost.processor;
  for (const Refinement& refinement : refinements_)
    cost.add(read_compared_run(folder_ / run_name(refinement, "fine")).cost.processor / at_middle);
  std::vector<double> wanted;
  for (const ValueError& error : errors_) wanted.push_back(wanted_error(options_.to, error.extrapolated));
  const std::optional<Factors> factors = cheapest_factors(errors_, wanted, cost);
  if (!factors) {
    std::cerr << "no setting is good enough (" << options_.to
              << " would need parameters finer by more than 64) allow a larger error, or begin finer with --coarsest\n";
    return ExitCode::failed;
  }
  // Each choice has a folder of its own: another call may ask for another error.
  std::string name = chosen;
  Factors of_scene = *factors;
  for (double& factor : of_scene) {
    name += fmt::format("_{:.0f}", 2 * std::log2(factor));
    factor *= middle_factor();
  }
  const ExitCode code = sweep({{chosen, of_scene}}, folder_ / name);
  if (code != ExitCode::done) return code;
  bool is_reached = true;
  std::vector<std::vector<std::string>> rows = {{"quantity", "value", "± error", "of it"}};
  Json values = Json::array();
  std::size_t i = 0;
  for (const FigureOptions& options : study_->table) {
    const double value = figure(options, fs::path(name) / chosen), stated = errors_[i].stated(*factors);
    is_reached = is_reached && std::abs(value - errors_[i].extrapolated) <= wanted[i];
    rows.push_back({options.name, display_text(value, units_[i], digits), display_text(stated, units_[i], 2),
                    value == 0 ? "–" : fmt::format("{:.2g} %", 100 * stated / std::abs(value))});
    values.push_back({{"quantity", options.name}, {"value", value}, {"error", stated}});
    ++i;
  }
  const double seconds = read_compared_run(folder_ / name / chosen).cost.processor;
  reached_ = {
      {"setting", setting_text(*factors)}, {"processor", seconds}, {"reached", is_reached}, {"quantities", values}};
  if (!options_.is_quiet)
    std::cout << "\nThe cheapest setting for " << options_.to << ", " << duration_text(seconds)
              << " of the processor, is " << setting_text(*factors) << "\n"
              << text_table(rows);
  if (!is_reached)
    std::cerr << "this setting is farther from the extrapolated value than " << options_.to
              << " (the estimate was too good) refine further with a smaller --coarsest\n";
  return is_reached ? ExitCode::done : ExitCode::failed;
}

ExitCode Convergence::execute() {
  ExitCode code = sweep(levels(), folder_);
  if (code == ExitCode::failed)
    std::cerr << "no errors are told (a run has failed, see its log in " << folder_.string() << ")\n";
  if (code != ExitCode::done) return code;
  estimate();
  if (!options_.is_quiet) std::cout << table();
  for (std::size_t i = 0; i < errors_.size(); ++i)
    for (std::size_t k = 0; k < refinements_.size(); ++k)
      if (!errors_[i].parameters[k].is_regular && !options_.is_quiet)
        std::cout << "note: " << std::next(study_->table.begin(), static_cast<std::ptrdiff_t>(i))->name
                  << " does not converge regularly with " << refinements_[k].name
                  << ": nothing is extrapolated, and its error is that of an order of one or none\n";
  if (!options_.to.empty()) code = reach();
  write_atomically(folder_ / "converge.json", record().dump(2) + "\n");
  return code;
}

}  // namespace

ExitCode run_convergence(const ConvergenceOptions& options) { return Convergence(options).execute(); }

}  // namespace sprekk
