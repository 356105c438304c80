#include "framework/study/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "framework/output/atomic_file.hpp"
#include "framework/output/build_info.hpp"
#include "framework/output/vtu_writer.hpp"
#include "framework/picture/display_unit.hpp"
#include "framework/picture/history_panel.hpp"
#include "framework/picture/text_table.hpp"
#include "framework/report/html.hpp"
#include "framework/scene/model.hpp"

namespace sprekk {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
namespace {

constexpr std::size_t plots_by_default = 6;

ColumnNames columns_of(const Scene& scene) {
  ColumnNames names = {"time[s]", "step[s]", "iterations[1]"};
  for (const Quantity& quantity : Model(scene).quantities()) names.push_back(labelled(quantity.name, quantity.unit));
  return names;
}

bool has(const ColumnNames& names, const std::string& wanted) {
  return std::any_of(names.begin(), names.end(),
                     [&](const std::string& name) { return name == wanted || column_name(name).quantity == wanted; });
}

/// Runs may differ in their components, and so in their columns. Mostly the first run has all wanted columns; the
/// models of the others are built only as long as some column has not been found.
ColumnNames known_columns(const Study& study) {
  ColumnNames wanted = study.plot, known;
  for (const FigureOptions& figure : study.table) wanted.push_back(figure.of);
  for (const StudyRun& run : study.runs) {
    for (const std::string& name : columns_of(study.scene_of(run)))
      if (std::find(known.begin(), known.end(), name) == known.end()) known.push_back(name);
    if (std::all_of(wanted.begin(), wanted.end(), [&](const std::string& name) { return has(known, name); })) break;
  }
  return known;
}

CsvTable history_of(const fs::path& folder, const RunState& state) {
  return CsvTable::read(folder / state.name / "history.csv");
}

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c == '\n' ? ' ' : c);
  return result + "\"";
}

std::string csv_number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

Json json_number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

}  // namespace

Comparison::Comparison(const Study& study) : study_(study) {
  const ColumnNames known = known_columns(study);
  for (const std::string& column : study.plot) plot_.push_back(find_column(known, column, study.plot_origin));
  if (study.plot.empty())
    for (std::size_t i = 3; i < known.size() && plot_.size() < plots_by_default; ++i) plot_.push_back(known[i]);
  for (const FigureOptions& options : study.table) figures_.emplace_back(options, known);
  if (!study.table.empty()) return;
  for (const std::string& column : plot_) {
    FigureOptions options;
    options.name = "final " + column_name(column).quantity;
    options.of = column;
    options.at = "end";
    figures_.emplace_back(options, known);
  }
}

std::vector<Comparison::Row> Comparison::rows(const fs::path& folder, const std::vector<RunState>& states) const {
  std::vector<Row> rows;
  for (const RunState& state : states) {
    const bool is_done = state.status == RunState::Status::done;
    const CsvTable history = is_done ? history_of(folder, state) : CsvTable();
    Row row;
    for (const Figure& figure : figures_) row.figures.push_back(figure.of(history));
    rows.push_back(row);
  }
  if (!study_.reference) return rows;
  const auto reference = std::find_if(states.begin(), states.end(),
                                      [&](const RunState& state) { return state.name == *study_.reference; });
  const std::vector<double> expected = rows[static_cast<std::size_t>(reference - states.begin())].figures;
  for (Row& row : rows)
    for (std::size_t i = 0; i < figures_.size(); ++i) {
      const double deviation = 100 * (row.figures[i] / expected[i] - 1);
      row.deviations.push_back(row.figures[i] == expected[i] ? 0 : deviation);
    }
  return rows;
}

std::string Comparison::csv(const std::vector<Row>& rows, const std::vector<RunState>& states) const {
  std::string text = "run";
  for (const std::string& key : study_.keys) text += "," + csv_text(key);
  for (const Figure& figure : figures_) text += "," + csv_text(figure.heading());
  if (study_.reference)
    for (const Figure& figure : figures_) text += "," + csv_text("deviation of " + figure.name() + "[%]");
  text += ",state,exit_code[1],seconds[s],program,reason\n";
  for (std::size_t i = 0; i < states.size(); ++i) {
    const RunState& state = states[i];
    text += csv_text(state.name);
    for (const std::string& value : study_.runs[i].values) text += "," + csv_text(value);
    for (const double figure : rows[i].figures) text += "," + csv_number(figure);
    for (const double deviation : rows[i].deviations) text += "," + csv_number(deviation);
    text += fmt::format(",{},{},{:.3f},{},{}\n", status_text(state.status), state.exit_code, state.seconds,
                        csv_text(state.program), csv_text(state.reason));
  }
  return text;
}

std::string Comparison::record(const std::vector<Row>& rows, const std::vector<RunState>& states) const {
  Json runs = Json::array();
  for (std::size_t i = 0; i < states.size(); ++i) {
    const RunState& state = states[i];
    Json values = Json::object(), figures = Json::object(), deviations = Json::object();
    for (std::size_t k = 0; k < study_.keys.size(); ++k) values[study_.keys[k]] = study_.runs[i].values[k];
    for (std::size_t k = 0; !rows.empty() && k < figures_.size(); ++k) {
      figures[figures_[k].heading()] = json_number(rows[i].figures[k]);
      if (study_.reference) deviations[figures_[k].name()] = json_number(rows[i].deviations[k]);
    }
    Json run = {{"name", state.name},           {"values", values},          {"state", status_text(state.status)},
                {"exit_code", state.exit_code}, {"reason", state.reason},    {"seconds", state.seconds},
                {"program", state.program},     {"identity", state.identity}};
    if (!rows.empty()) run["figures"] = figures;
    if (!rows.empty() && study_.reference) run["deviations[%]"] = deviations;
    runs.push_back(run);
  }
  Json whole = {{"study", study_.name},
                {"scene", study_.scene_files},
                {"program", build_info().version + " " + build_info().git_commit},
                {"keys", study_.keys},
                {"runs", runs}};
  if (study_.reference) whole["reference"] = *study_.reference;
  return whole.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<Panel> Comparison::panels(const fs::path& folder, const std::vector<RunState>& states) const {
  std::vector<CsvTable> histories;
  for (const RunState& state : states) histories.push_back(history_of(folder, state));
  std::vector<Panel> panels;
  for (const std::string& column : plot_) {
    std::vector<HistoryCurve> curves;
    for (std::size_t i = 0; i < states.size(); ++i) {
      const std::vector<double> values = histories[i].numbers(column);
      const bool is_done = states[i].status == RunState::Status::done;
      const std::string name = states[i].name + (is_done ? "" : " (" + status_text(states[i].status) + ")");
      if (!values.empty()) curves.push_back({name, histories[i].numbers("time[s]"), values, line_style(int(i))});
    }
    panels.push_back(history_panel(column_name(column).quantity, column_name(column).unit, curves));
  }
  return panels;
}

std::string Comparison::picture(const fs::path& folder, const std::vector<RunState>& states) const {
  const std::vector<Panel> all = panels(folder, states);
  return svg_document(all, all.size() > 1 ? 2 : 1);
}

std::vector<Comparison::Spread> Comparison::spreads(const std::vector<Row>& rows) const {
  std::vector<std::string> groups;
  for (const StudyRun& run : study_.runs)
    if (!run.samples_of.empty() && std::ranges::count(groups, run.samples_of) == 0) groups.push_back(run.samples_of);
  std::vector<Spread> spreads;
  for (const std::string& group : groups)
    for (std::size_t k = 0; k < figures_.size(); ++k) {
      std::vector<double> numbers;
      for (std::size_t i = 0; i < rows.size(); ++i)
        if (study_.runs[i].samples_of == group) numbers.push_back(rows[i].figures[k]);
      spreads.push_back({group, k, distribution_of(numbers)});
    }
  return spreads;
}

std::string Comparison::quantiles(const std::vector<Spread>& spreads) const {
  std::string text = "samples of,figure,count[1],mean,deviation";
  for (const double share : quantile_shares) text += fmt::format(",{:g} %", 100 * share);
  text += "\n";
  for (const Spread& spread : spreads) {
    text += csv_text(spread.samples_of) + "," + csv_text(figures_[spread.figure].heading()) +
            fmt::format(",{},{},{}", spread.distribution.count, csv_number(spread.distribution.mean),
                        csv_number(spread.distribution.deviation));
    for (const double quantile : spread.distribution.quantiles) text += "," + csv_number(quantile);
    text += "\n";
  }
  return text;
}

Comparison::Table Comparison::spread_table(const std::vector<Spread>& spreads) const {
  Table cells(1, {"samples of", "figure", "runs", "mean", "deviation"});
  for (const double share : quantile_shares) cells.front().push_back(fmt::format("{:g} %", 100 * share));
  for (const Spread& spread : spreads) {
    const Figure& figure = figures_[spread.figure];
    const Distribution& of = spread.distribution;
    cells.push_back({spread.samples_of, figure.name(), std::to_string(of.count), display_text(of.mean, figure.unit()),
                     display_text(of.deviation, figure.unit())});
    for (const double quantile : of.quantiles) cells.back().push_back(display_text(quantile, figure.unit()));
  }
  return cells;
}

Comparison::Table Comparison::figure_table(const std::vector<Row>& rows, const std::vector<RunState>& states) const {
  Table cells(1, {"run"});
  for (const Figure& figure : figures_) {
    cells.front().push_back(figure.name());
    if (study_.reference) cells.front().push_back("deviation");
  }
  for (std::size_t i = 0; i < states.size(); ++i) {
    cells.push_back({states[i].name});
    for (std::size_t k = 0; k < figures_.size(); ++k) {
      cells.back().push_back(display_text(rows[i].figures[k], figures_[k].unit()));
      if (!study_.reference) continue;
      const double deviation = rows[i].deviations[k];
      cells.back().push_back(std::isfinite(deviation) ? fmt::format("{:+.2f} %", deviation) : "–");
    }
  }
  return cells;
}

std::string Comparison::page(const fs::path& folder, const std::vector<Row>& rows,
                             const std::vector<RunState>& states) const {
  std::string body;
  if (study_.has_samples)
    body += html_section("quantiles", "Quantiles of the samples", html_table(spread_table(spreads(rows)), 2));
  body += html_section("figures", "Figures of the runs", html_table(figure_table(rows, states)));
  body += html_section("history", "Against time", html_panels(panels(folder, states)));
  return html_page(
      study_.name,
      {{"quantiles", "Quantiles of the samples"}, {"figures", "Figures of the runs"}, {"history", "Against time"}},
      body);
}

void Comparison::write_record(const fs::path& folder, const std::vector<RunState>& states) const {
  write_atomically(folder / "sweep.json", record({}, states));
}

void Comparison::write(const fs::path& folder, const std::vector<RunState>& states) const {
  const std::vector<Row> all = rows(folder, states);
  write_atomically(folder / "sweep.csv", csv(all, states));
  write_atomically(folder / "sweep.svg", picture(folder, states));
  write_atomically(folder / "sweep.html", page(folder, all, states));
  if (study_.has_samples) write_atomically(folder / "quantiles.csv", quantiles(spreads(all)));
  write_atomically(folder / "sweep.json", record(all, states));
}

std::string Comparison::text(const fs::path& folder, const std::vector<RunState>& states) const {
  const std::vector<Row> all = rows(folder, states);
  return text_table(study_.has_samples ? spread_table(spreads(all)) : figure_table(all, states));
}

}  // namespace sprekk
