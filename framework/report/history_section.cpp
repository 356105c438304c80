#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "framework/picture/display_unit.hpp"
#include "framework/picture/history_panel.hpp"
#include "framework/report/html.hpp"
#include "framework/report/quiet_values.hpp"
#include "framework/report/sections.hpp"

namespace sprekk {
namespace {

constexpr std::size_t most_curves = 8;  // in a panel
constexpr double similar = 8;           // the largest ratio of the sizes of curves that share a panel

/// The names under `output.probes` of the scene.
std::set<std::string> probe_names(const RunResults& results) {
  const nlohmann::json record = nlohmann::json::parse(results.record);
  const std::string head = "output.probes.";
  std::set<std::string> names;
  const auto parameters = record.value("/scene/parameters"_json_pointer, nlohmann::json::object());
  for (const auto& [path, parameter] : parameters.items())
    if (path.rfind(head, 0) == 0) names.insert(path.substr(head.size(), path.find('.', head.size()) - head.size()));
  return names;
}

bool has_numbers(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

/// Panels of curves that share a unit. Curves that are much smaller than the rest get a panel of their own, where they
/// can be seen.
struct Group {
  std::string unit;
  double largest;  ///< absolute value of the first curve
  std::vector<HistoryCurve> curves;
};

void add(std::vector<Group>& groups, const std::string& unit, HistoryCurve curve) {
  const double largest = largest_size(curve.values);
  for (Group& group : groups) {
    const double ratio = group.largest > 0 ? largest / group.largest : 0;
    const bool fits = unit.empty() || largest == 0 || (ratio < similar && ratio > 1 / similar);
    if (group.unit != unit || !fits || group.curves.size() == most_curves) continue;
    curve.style = line_style(static_cast<int>(group.curves.size()));
    group.curves.push_back(std::move(curve));
    return;
  }
  curve.style = line_style(0);
  groups.push_back({unit, largest, {std::move(curve)}});
}

/// Of all columns behind the first three, which are time, step and iterations.
SizesOfUnits sizes_in(const CsvTable& history) {
  SizesOfUnits sizes;
  for (std::size_t i = 3; i < history.columns().size(); ++i)
    sizes.add(column_name(history.columns()[i]).unit, history.numbers(static_cast<int>(i)));
  return sizes;
}

std::vector<Panel> panels(const std::vector<Group>& groups, const CsvTable& events) {
  std::vector<Panel> result;
  for (Group group : groups) {
    HistoryCurve points = event_points();
    for (const HistoryCurve& curve : group.curves)
      add_event_points(points, events, curve.name.substr(0, curve.name.rfind('.')), curve);
    std::string title = group.curves.front().name;
    if (group.curves.size() > 1) title += ", …";
    if (!points.times.empty()) group.curves.push_back(std::move(points));
    result.push_back(history_panel(title, group.unit, group.curves));
  }
  return result;
}

}  // namespace

std::vector<ThingColumn> thing_columns(const CsvTable& history) {
  std::vector<ThingColumn> found;
  for (std::size_t i = 0; i < history.columns().size(); ++i) {
    const ColumnName name = column_name(history.columns()[i]);
    const std::size_t last = name.quantity.rfind('.');
    if (std::count(name.quantity.begin(), name.quantity.end(), '.') != 2) continue;
    found.push_back({name.quantity.substr(0, last), name.quantity.substr(last + 1), name.unit, static_cast<int>(i)});
  }
  return found;
}

std::string history_section(const RunResults& results) {
  const CsvTable& history = results.history;
  if (history.row_count() == 0) return "";
  const std::vector<double> times = history.numbers("time[s]");
  const std::set<std::string> probes = probe_names(results);
  const std::vector<ThingColumn> things = thing_columns(history);
  std::vector<Group> probed, reported;
  QuietValues quiet_probes(sizes_in(history)), quiet = quiet_probes;
  for (std::size_t i = 3; i < history.columns().size(); ++i) {
    const ColumnName name = column_name(history.columns()[i]);
    const bool is_elsewhere = std::any_of(
        things.begin(), things.end(), [&](const ThingColumn& thing) { return thing.column == static_cast<int>(i); });
    const std::vector<double> values = history.numbers(static_cast<int>(i));
    if (is_elsewhere || !has_numbers(values)) continue;
    const bool is_probe =
        probes.count(name.quantity) > 0 || probes.count(name.quantity.substr(0, name.quantity.rfind('.'))) > 0;
    if ((is_probe ? quiet_probes : quiet).take(name.quantity, name.unit, values)) continue;
    add(is_probe ? probed : reported, name.unit, {name.quantity, times, values, {}});
  }
  const auto part = [&](const char* title, const std::vector<Group>& groups, const QuietValues& undrawn) {
    const std::string content = html_panels(panels(groups, results.events)) + undrawn.told();
    return groups.empty() && undrawn.told().empty() ? "" : "<h3>" + std::string(title) + "</h3>\n" + content;
  };
  return html_section("history", "Against time",
                      part("Probes", probed, quiet_probes) + part("Reported by the components", reported, quiet));
}

std::string tip_section(const RunResults& results) {
  const std::vector<ThingColumn> columns = thing_columns(results.history);
  const std::vector<double> times = results.history.numbers("time[s]");
  // Each unit and thing (a tip, for example) has a panel. A unit with one quantity only has one panel for all things.
  std::map<std::string, std::set<std::string>> quantities;
  for (const ThingColumn& column : columns) quantities[column.unit].insert(column.quantity);
  struct TipGroup {
    std::string title, unit;
    std::vector<HistoryCurve> curves;
    HistoryCurve events;
  };
  std::vector<TipGroup> groups;
  QuietValues quiet(sizes_in(results.history));
  for (const ThingColumn& column : columns) {
    const std::vector<double> values = results.history.numbers(column.column);
    if (quiet.take(column.thing + "." + column.quantity, column.unit, values)) continue;
    const bool is_alone = quantities[column.unit].size() == 1;
    const std::string title = is_alone ? column.quantity : column.thing;
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const TipGroup& other) { return other.title == title && other.unit == column.unit; });
    if (group == groups.end()) group = groups.insert(groups.end(), {title, column.unit, {}, event_points()});
    group->curves.push_back(
        {is_alone ? column.thing : column.quantity, times, values, line_style(static_cast<int>(group->curves.size()))});
    add_event_points(group->events, results.events, column.thing, group->curves.back());
  }
  std::stable_sort(groups.begin(), groups.end(), [&](const TipGroup& a, const TipGroup& b) {
    return quantities[a.unit].size() > quantities[b.unit].size();
  });
  std::vector<Panel> drawn;
  for (TipGroup& group : groups) {
    if (!group.events.times.empty()) group.curves.push_back(std::move(group.events));
    drawn.push_back(history_panel(group.title, group.unit, group.curves));
  }
  return html_section("tips", "By tip, side and other place", html_panels(drawn) + quiet.told());
}

}  // namespace sprekk
