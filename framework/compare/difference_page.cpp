#include "framework/compare/difference_page.hpp"

#include <algorithm>
#include <cmath>

#include "framework/compare/difference_tables.hpp"
#include "framework/compare/scale.hpp"
#include "framework/no_value.hpp"
#include "framework/output/progress.hpp"
#include "framework/picture/display_unit.hpp"
#include "framework/picture/history_panel.hpp"
#include "framework/report/html.hpp"

namespace sprekk {
namespace {

constexpr std::size_t most_panels = 36;

std::string heading(const RunDifference& difference) {
  return "<h3>" + escaped_markup(difference.other->name + " against " + difference.run->name) + "</h3>\n";
}

std::string summary(const std::vector<ComparedRun>& runs, const std::vector<RunDifference>& differences,
                    std::optional<double> tolerance) {
  std::string text;
  for (const RunDifference& difference : differences) {
    text += heading(difference);
    if (tolerance) {
      const std::string badge = is_within(difference, *tolerance) ? "good\">within" : "bad\">beyond";
      text +=
          "<p><span class=\"badge " + badge + "</span>" + escaped_markup(verdict(difference, *tolerance)) + "</p>\n";
    }
    for (const std::string& remark : difference.remarks)
      text += "<p class=\"warning\">" + escaped_markup(remark) + "</p>\n";
  }
  return html_section("summary", "Summary", text + "<h3>Cost</h3>\n" + html_table(cost_rows(runs)));
}

/// A table for each pair of runs.
template <class Rows>
std::string tables(const std::vector<RunDifference>& differences, const Rows& rows) {
  std::string text;
  for (const RunDifference& difference : differences) {
    const TextRows its = rows(difference);
    if (its.size() > 1) text += heading(difference) + html_table(its);
  }
  return text;
}

/// All runs in a panel for each column, the columns of the largest differences first.
std::string curves(const std::vector<ComparedRun>& runs, const std::vector<RunDifference>& differences) {
  std::vector<std::pair<double, std::string>> columns;
  for (const RunDifference& difference : differences)
    for (const HistoryDifference& history : difference.histories) {
      const double share = relative(history.largest, history.scale);
      const auto known = std::find_if(columns.begin(), columns.end(),
                                      [&](const auto& column) { return column.second == history.column; });
      if (known == columns.end())
        columns.emplace_back(share, history.column);
      else
        known->first = std::max(known->first, share);
    }
  std::stable_sort(columns.begin(), columns.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Panel> panels;
  for (const auto& [share, column] : columns) {
    if (panels.size() == most_panels) break;
    std::vector<HistoryCurve> drawn;
    for (std::size_t i = 0; i < runs.size(); ++i)
      if (runs[i].history.find(column) >= 0)
        drawn.push_back({runs[i].name, runs[i].history.numbers("time[s]"), runs[i].history.numbers(column),
                         line_style(static_cast<int>(i))});
    const ColumnName name = column_name(column);
    panels.push_back(history_panel(name.quantity, name.unit, drawn));
  }
  return html_panels(panels);
}

/// The lines of all runs at the last time at which the first one and the others have written fields.
std::string lines(const std::vector<RunDifference>& differences) {
  Panel panel;
  panel.equal_axes = true;
  panel.height = 420;
  panel.x_label = "x [m]";
  panel.y_label = "y [m]";
  panel.title = "paths of the fractures";
  const auto add = [&](const ComparedRun& run, double time) {
    Curve curve{run.name, {}, {}, line_style(static_cast<int>(panel.curves.size()))};
    for (const Polyline& line : polylines_at(run, time))
      for (const auto& [a, b] : line.segments) {
        curve.x.insert(curve.x.end(), {a[0], b[0], no_value});
        curve.y.insert(curve.y.end(), {a[1], b[1], no_value});
      }
    if (curve.x.empty()) return;
    if (!panel.curves.empty()) curve.style.dash = "6 4";
    panel.curves.push_back(std::move(curve));
  };
  for (const RunDifference& difference : differences) {
    if (!difference.written || difference.paths.empty()) continue;
    if (panel.curves.empty()) add(*difference.run, *difference.written);
    add(*difference.other, *difference.written);
  }
  return panel.curves.size() < 2 ? "" : html_panels({panel});
}

}  // namespace

std::string difference_page(const std::vector<ComparedRun>& runs, const std::vector<RunDifference>& differences,
                            std::optional<double> tolerance) {
  std::string title = runs.front().name;
  for (std::size_t i = 1; i < runs.size(); ++i) title += " and " + runs[i].name;
  const std::string body =
      summary(runs, differences, tolerance) +
      html_section("history", "Against time", tables(differences, history_rows) + curves(runs, differences)) +
      html_section("fields", "Fields", tables(differences, field_rows)) +
      html_section("paths", "Paths", tables(differences, path_rows) + lines(differences));
  return html_page(
      title, {{"summary", "Summary"}, {"history", "Against time"}, {"fields", "Fields"}, {"paths", "Paths"}}, body);
}

}  // namespace sprekk
