#include "framework/compare/run_difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "framework/compare/body_difference.hpp"
#include "framework/compare/scale.hpp"
#include "framework/config/input_error.hpp"
#include "framework/output/progress.hpp"
#include "framework/picture/display_unit.hpp"
#include "framework/report/fracture_names.hpp"
#include "framework/results/results_dimension.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

const Snapshot* written_at(const std::vector<Snapshot>& all, double time) {
  for (const Snapshot& snapshot : all)
    if (std::abs(snapshot.time - time) <= rounding::same * std::max(std::abs(time), std::abs(snapshot.time)))
      return &snapshot;
  return nullptr;
}

bool is_in_space(const ComparedRun& run) { return dimension_of_results(run.name) == 3; }

/// Empty where there is none, and in space.
Grid grid_at(const std::vector<Snapshot>& all, double time) {
  const Snapshot* const snapshot = written_at(all, time);
  if (snapshot && dimension_of_results(snapshot->file.parent_path()) == 3) return {};
  return snapshot == nullptr ? Grid{} : read_grid(snapshot->file);
}

std::optional<double> last_common_time(const ComparedRun& run, const ComparedRun& other) {
  for (auto it = run.matrix.rbegin(); it != run.matrix.rend(); ++it)
    if (written_at(other.matrix, it->time) != nullptr) return it->time;
  return std::nullopt;
}

std::string named(const ComparedRun& run, const std::vector<std::string>& names) {
  return "only in " + run.name + ": " + listed(names);
}

std::vector<std::string> not_in(const std::vector<std::string>& names, const std::vector<std::string>& others) {
  std::vector<std::string> missing;
  for (const std::string& name : names)
    if (std::find(others.begin(), others.end(), name) == others.end()) missing.push_back(column_name(name).quantity);
  return missing;
}

std::vector<std::string> array_names(const Grid& grid) {
  std::vector<std::string> names;
  for (const Grid::Values& array : grid.arrays)
    if (array.name.ends_with(']')) names.push_back(array.name);
  return names;
}

void remark_endings(RunDifference& difference) {
  for (const ComparedRun* run : {difference.run, difference.other})
    if (!run->is_done) {
      const std::vector<double> times = run->history.numbers("time[s]");
      difference.remarks.push_back(run->name + " has not come to its end" +
                                   (times.empty() ? "" : ", it has reached " + duration_text(times.back())) + " (" +
                                   run->ending + ")");
    }
}

/// Adds a remark on quantities that only one of the two lists has.
void remark_missing(RunDifference& difference, const std::vector<std::string>& names,
                    const std::vector<std::string>& others) {
  const std::vector<std::string> here = not_in(names, others), there = not_in(others, names);
  if (!here.empty()) difference.remarks.push_back(named(*difference.run, here));
  if (!there.empty()) difference.remarks.push_back(named(*difference.other, there));
}

void compare_histories(RunDifference& difference) {
  const CsvTable &history = difference.run->history, &other = difference.other->history;
  difference.time = common_time(history, other);
  difference.histories = history_differences(history, other);
  remark_missing(difference, history.columns(), other.columns());
  const std::vector<double> times = history.numbers("time[s]"), others = other.numbers("time[s]");
  if (times.empty() || others.empty()) return;
  if (difference.time.first > difference.time.last)
    difference.remarks.push_back("the histories have no time in common");
  else if (std::abs(times.back() - others.back()) > rounding::same * std::max(times.back(), others.back()))
    difference.remarks.push_back(fmt::format(
        "compared until {}: {} ends at {}, {} at {}", duration_text(difference.time.last), difference.run->name,
        duration_text(times.back()), difference.other->name, duration_text(others.back())));
}

void remark_meshes(RunDifference& difference, int cells, int other_cells) {
  const GridDifference& matrix = difference.matrix;
  if (matrix.is_same_mesh) return;
  difference.remarks.push_back(
      fmt::format("the meshes differ: {} cells in {}, {} in {}; fields are compared at the {} cells of the finer one",
                  cells, difference.run->name, other_cells, difference.other->name, matrix.compared));
  if (matrix.outside > 0)
    difference.remarks.push_back(
        fmt::format("{} cells of the finer mesh are left out (the other one does not cover them)", matrix.outside));
}

void compare_bodies(RunDifference& difference) {
  const ComparedRun &run = *difference.run, &other = *difference.other;
  const auto read = [&](const std::vector<Snapshot>& all) {
    const Snapshot* const snapshot = written_at(all, *difference.written);
    return snapshot == nullptr ? GridData{} : read_whole(snapshot->file);
  };
  const GridData matrix = read(run.matrix), other_matrix = read(other.matrix);
  difference.matrix = body_difference(matrix, other_matrix);
  remark_meshes(difference, matrix.cell_count(), other_matrix.cell_count());
  const GridData surfaces = read(run.fractures), other_surfaces = read(other.fractures);
  difference.fractures = body_difference(surfaces, other_surfaces);
  if (surfaces.cell_count() > 0 && other_surfaces.cell_count() > 0 && !difference.fractures.is_same_mesh)
    difference.remarks.push_back("fields on fractures in space are compared on equal meshes only");
}

void compare_fields(RunDifference& difference) {
  const ComparedRun &run = *difference.run, &other = *difference.other;
  difference.written = last_common_time(run, other);
  if (!difference.written) {
    if (!run.matrix.empty() || !other.matrix.empty())
      difference.remarks.push_back("no fields are compared (there is no time at which both runs have written them)");
    return;
  }
  if (is_in_space(run) != is_in_space(other)) {
    difference.remarks.push_back("no fields are compared (one run is in a plane, the other one in space)");
    return;
  }
  if (is_in_space(run)) return compare_bodies(difference);
  const double time = *difference.written;
  const Grid matrix = grid_at(run.matrix, time), other_matrix = grid_at(other.matrix, time);
  const Grid lines = grid_at(run.fractures, time), other_lines = grid_at(other.fractures, time);
  if (matrix.cell_count() > 0 && other_matrix.cell_count() > 0) {
    difference.matrix = grid_difference(matrix, lines, other_matrix, other_lines);
    remark_meshes(difference, matrix.sources.back() + 1, other_matrix.sources.back() + 1);
  }
  difference.fractures = grid_difference(lines, {}, other_lines, {});
  remark_missing(difference, array_names(matrix), array_names(other_matrix));
  remark_missing(difference, array_names(lines), array_names(other_lines));
  const std::vector<Polyline> polyline = polylines_at(run, time), other_polyline = polylines_at(other, time);
  difference.fracture_names = fracture_names(run.record, std::max(polyline.size(), other_polyline.size()));
  for (std::size_t i = 0; i < std::max(polyline.size(), other_polyline.size()); ++i) {
    const bool is_here = i < polyline.size() && !polyline[i].segments.empty();
    const bool is_there = i < other_polyline.size() && !other_polyline[i].segments.empty();
    if (is_here && is_there) {
      difference.paths.push_back(path_difference(polyline[i], other_polyline[i]));
      difference.paths.back().fracture = static_cast<int>(i);
    } else if (is_here || is_there) {
      difference.remarks.push_back(named(is_here ? run : other, {difference.fracture_names[i]}));
    }
  }
}

/// Keeps the quantities that are asked for; throws InputError for an unknown one.
void keep_only(RunDifference& difference, const std::vector<std::string>& only) {
  std::set<std::string> names;
  const auto is_wanted = [&](const std::string& column) {
    const std::string name = column_name(column).quantity;
    names.insert(name);
    return std::find(only.begin(), only.end(), name) != only.end();
  };
  std::erase_if(difference.histories, [&](const HistoryDifference& d) { return !is_wanted(d.column); });
  for (GridDifference* grid : {&difference.matrix, &difference.fractures})
    std::erase_if(grid->fields, [&](const FieldDifference& d) { return !is_wanted(d.array); });
  if (!difference.paths.empty() && !is_wanted("paths")) difference.paths.clear();
  for (const std::string& name : only)
    if (names.count(name) == 0)
      throw unknown_name({"--of"}, "quantity", name, std::vector<std::string>(names.begin(), names.end()));
}

}  // namespace

RunDifference run_difference(const ComparedRun& run, const ComparedRun& other, const std::vector<std::string>& only) {
  RunDifference difference;
  difference.run = &run;
  difference.other = &other;
  remark_endings(difference);
  compare_histories(difference);
  compare_fields(difference);
  if (difference.compared() == 0) {
    std::string why = "they have no quantity and no time in common";
    for (const ComparedRun* of : {&run, &other})
      if (of->history.row_count() == 0) why = of->name + " has no step, it is: " + of->ending;
    throw InputError({run.name + " and " + other.name}, "there is nothing to compare", why,
                     "give runs of one scene, or of scenes with the same components");
  }
  if (!only.empty()) keep_only(difference, only);
  return difference;
}

std::vector<Polyline> polylines_at(const ComparedRun& run, double time) {
  return polylines(grid_at(run.fractures, time), grid_at(run.paths, time));
}

std::vector<Deviation> deviations(const RunDifference& difference) {
  std::vector<Deviation> all;
  for (const HistoryDifference& history : difference.histories)
    all.push_back({column_name(history.column).quantity, relative(history.largest, history.scale)});
  for (const GridDifference* grid : {&difference.matrix, &difference.fractures})
    for (const FieldDifference& field : grid->fields)
      all.push_back({"the field " + column_name(field.array).quantity, relative(field.largest, field.scale)});
  for (const PathDifference& path : difference.paths)
    all.push_back({"the path of " + difference.fracture_names[static_cast<std::size_t>(path.fracture)],
                   relative(path.largest(), path.scale)});
  std::stable_sort(all.begin(), all.end(), [](const Deviation& a, const Deviation& b) { return a.share > b.share; });
  return all;
}

}  // namespace sprekk
