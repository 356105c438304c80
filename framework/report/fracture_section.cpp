#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "framework/no_value.hpp"
#include "framework/output/progress.hpp"
#include "framework/picture/display_unit.hpp"
#include "framework/report/fracture_names.hpp"
#include "framework/report/fracture_path.hpp"
#include "framework/report/html.hpp"
#include "framework/report/network_map.hpp"
#include "framework/report/quiet_values.hpp"
#include "framework/report/sections.hpp"
#include "framework/types.hpp"

namespace sprekk {
namespace {

constexpr std::size_t most_fractures = 12;  // with curves of their own; more are maps
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// A fracture at the written times.
struct FractureHistory {
  std::vector<double> times;
  std::vector<const Grid*> grids;
  std::vector<std::vector<FracturePath>> paths;
};

std::map<int, FractureHistory> fracture_histories(const RunResults& results) {
  std::map<int, FractureHistory> all;
  std::map<int, std::optional<PathOrigin>> origins;
  for (const RunResults::Written& written : results.written) {
    const Grid::Values* const number = written.fractures.find("fracture");
    if (number == nullptr) continue;
    std::map<int, std::vector<int>> cells;
    for (std::size_t i = 0; i < number->values.size(); ++i)
      cells[static_cast<int>(number->values[i])].push_back(static_cast<int>(i));
    for (const auto& [fracture, its] : cells) {
      all[fracture].times.push_back(written.time);
      all[fracture].grids.push_back(&written.fractures);
      all[fracture].paths.push_back(fracture_paths(written.fractures, its, origins[fracture]));
    }
  }
  return all;
}

LineStyle time_style(std::size_t i, std::size_t count) {
  const double fraction = count < 2 ? 0 : static_cast<double>(i) / static_cast<double>(count - 1);
  return {viridis(0.88 * fraction), ""};
}

double largest_of(const FractureHistory& through, const std::string& array) {
  double largest = 0;
  for (const Grid* grid : through.grids)
    if (const Grid::Values* values = grid->find(array))
      for (const double value : values->values)
        if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  return largest;
}

/// A component of an array at all times and in all cells of a fracture.
std::vector<double> values_of(const FractureHistory& through, const Grid::Values& sample, int component) {
  std::vector<double> all;
  for (std::size_t t = 0; t < through.times.size(); ++t) {
    const Grid::Values* const values = through.grids[t]->find(sample.name);
    if (values == nullptr) continue;
    for (const FracturePath& path : through.paths[t])
      for (const int cell : path.cells)
        all.push_back(values->values[static_cast<std::size_t>(cell * values->components + component)]);
  }
  return all;
}

/// Of all arrays that are drawn along fractures.
SizesOfUnits sizes_in(const std::map<int, FractureHistory>& all) {
  SizesOfUnits sizes;
  for (const auto& [fracture, through] : all)
    for (const Grid* grid : through.grids)
      for (const Grid::Values& array : grid->arrays)
        if (array.place == Grid::Place::cell) sizes.add(column_name(array.name).unit, array.values);
  return sizes;
}

DisplayUnit time_unit_of(const FractureHistory& through) { return display_unit("s", through.times.back()); }

double longest_of(const FractureHistory& through) {
  double longest = 0;
  for (const auto& paths : through.paths)
    for (const FracturePath& path : paths) longest = std::max({longest, std::abs(path.start), std::abs(path.end)});
  return longest;
}

std::string title_of(const Grid::Values& sample, int component) {
  static const char* const axes[] = {", x", ", y"};
  return column_name(sample.name).quantity + (sample.components > 1 ? axes[component] : "");
}

/// One component of an array along the fracture at all times.
Panel panel_along(const FractureHistory& through, const Grid::Values& sample, int component) {
  const ColumnName name = column_name(sample.name);
  const DisplayUnit unit = display_unit(name.unit, largest_of(through, sample.name)),
                    length = display_unit("m", longest_of(through));
  Panel panel;
  panel.title = title_of(sample, component);
  panel.x_label = "arc length [" + length.text + "]";
  panel.y_label = unit.text;
  const DisplayUnit time_unit = time_unit_of(through);
  for (std::size_t t = 0; t < through.times.size(); ++t) {
    const Grid::Values* const values = through.grids[t]->find(sample.name);
    if (values == nullptr) continue;
    Curve curve{display_text(through.times[t], time_unit), {}, {}, time_style(t, through.times.size())};
    for (const FracturePath& path : through.paths[t]) {
      if (!curve.x.empty()) curve.x.push_back(no_value), curve.y.push_back(no_value);
      for (std::size_t i = 0; i < path.cells.size(); ++i) {
        curve.x.push_back(path.length[i] / length.scale);
        curve.y.push_back(values->values[static_cast<std::size_t>(path.cells[i] * values->components + component)] /
                          unit.scale);
      }
    }
    curve.marked = curve.x.size() <= 40;
    panel.curves.push_back(std::move(curve));
  }
  return panel;
}

/// Where the fractures run, coloured by time; those that do not grow are drawn over one another.
Panel paths_panel(const std::map<int, FractureHistory>& all) {
  double farthest = 0;
  for (const auto& [fracture, through] : all)
    for (const auto& paths : through.paths)
      for (const FracturePath& path : paths)
        for (const auto& point : path.points) farthest = std::max({farthest, std::abs(point[0]), std::abs(point[1])});
  const DisplayUnit unit = display_unit("m", farthest);
  Panel panel;
  panel.title = "paths of the fractures";
  panel.x_label = "x [" + unit.text + "]";
  panel.y_label = "y [" + unit.text + "]";
  panel.equal_axes = true;
  panel.height = 420;
  std::map<double, Curve> curves;  // the latest first, so that the oldest parts stay visible on top
  std::size_t count = 0;
  for (const auto& [fracture, through] : all) count = std::max(count, through.times.size());
  for (const auto& [fracture, through] : all)
    for (std::size_t t = 0; t < through.times.size(); ++t) {
      Curve& curve = curves[-through.times[t]];
      curve.name = display_text(through.times[t], time_unit_of(through));
      curve.style = time_style(t, count);
      for (const FracturePath& path : through.paths[t]) {
        if (!curve.x.empty()) curve.x.push_back(no_value), curve.y.push_back(no_value);
        for (const auto& point : path.points) {
          curve.x.push_back(point[0] / unit.scale);
          curve.y.push_back(point[1] / unit.scale);
        }
      }
    }
  for (auto& [time, curve] : curves) panel.curves.push_back(std::move(curve));
  return panel;
}

/// A map for each component of an array at the last time.
std::string maps_of(const std::map<int, FractureHistory>& all) {
  const FractureHistory& latest =
      std::ranges::max_element(all, {}, [](const auto& entry) { return entry.second.times.back(); })->second;
  const Grid* const last = latest.grids.back();
  std::vector<FracturePath> paths;
  for (const auto& [fracture, through] : all)
    if (through.grids.back() == last)
      paths.insert(paths.end(), through.paths.back().begin(), through.paths.back().end());
  std::vector<Panel> panels;
  QuietValues quiet(sizes_in(all));
  for (const Grid::Values& sample : last->arrays) {
    if (sample.name == "fracture" || sample.place != Grid::Place::cell) continue;
    const std::string unit = column_name(sample.name).unit;
    for (int c = 0; c < std::min(sample.components, 2); ++c) {
      std::vector<double> at_all_times, now;
      for (const auto& [fracture, through] : all) {
        const std::vector<double> its = values_of(through, sample, c);
        at_all_times.insert(at_all_times.end(), its.begin(), its.end());
      }
      if (quiet.take(title_of(sample, c), unit, at_all_times)) continue;
      for (int cell = 0; cell < last->cell_count(); ++cell)
        now.push_back(sample.values[static_cast<std::size_t>(cell * sample.components + c)]);
      panels.push_back(network_map(paths, now, title_of(sample, c), display_unit(unit, largest_size(now))));
    }
  }
  return html_panels(panels) + quiet.told();
}

bool has_grown(const std::map<int, FractureHistory>& all) {
  return std::any_of(all.begin(), all.end(), [](const auto& entry) {
    const auto& paths = entry.second.paths;
    return std::any_of(paths.begin(), paths.end(), [&](const auto& at_a_time) {
      return at_a_time.back().end - at_a_time.front().start >
             (paths.front().back().end - paths.front().front().start) * (1 + 1e-9);
    });
  });
}

}  // namespace

std::string fracture_section(const RunResults& results) {
  if (dimension == 3) return "";  // there is no arc length
  const std::map<int, FractureHistory> all = fracture_histories(results);
  if (all.empty()) return "";
  const std::vector<std::string> names =
      fracture_names(results.record, static_cast<std::size_t>(all.rbegin()->first) + 1);
  std::string text;
  if (has_grown(all)) text += html_panels({paths_panel(all)});
  if (all.size() > most_fractures) {
    text += html_paragraph(fmt::format(
        "All {} fractures at the last written time, coloured by each quantity in classes of as many cells. \"Fields\" "
        "shows them at other times, and "
        "probes and output.lines write values of one fracture.",
        all.size()));
    return html_section("fractures", "Along the fractures", text + maps_of(all));
  }
  text += html_paragraph(
      "Curves are coloured by time, from dark to light. The arc length begins at the end of the fracture where it was "
      "first written; what has grown there since has negative lengths.");
  const SizesOfUnits sizes = sizes_in(all);
  for (const auto& [fracture, through] : all) {
    std::vector<Panel> panels;
    QuietValues quiet(sizes);
    for (const Grid::Values& sample : through.grids.back()->arrays) {
      if (sample.name == "fracture" || sample.place != Grid::Place::cell) continue;
      for (int c = 0; c < std::min(sample.components, 2); ++c)
        if (!quiet.take(title_of(sample, c), column_name(sample.name).unit, values_of(through, sample, c)))
          panels.push_back(panel_along(through, sample, c));
    }
    text += "<h3>" + escaped_markup(names[static_cast<std::size_t>(fracture)]) + "</h3>\n" + html_panels(panels) +
            quiet.told();
  }
  return html_section("fractures", "Along the fractures", text);
}

}  // namespace sprekk
