#include "framework/compare/difference_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "framework/compare/scale.hpp"
#include "framework/output/progress.hpp"
#include "framework/picture/display_unit.hpp"
#include "framework/picture/text_table.hpp"

namespace sprekk {
namespace {

constexpr std::size_t most_rows = 20;   // of a table on the terminal
constexpr std::size_t most_beyond = 5;  // quantities of a verdict
constexpr int digits = 3;

std::string share_text(double share) {
  if (share == 0) return "0";
  return std::isfinite(share) ? fmt::format("{:.1e}", share) : "–";
}

std::string size_text(double value, const std::string& unit) {
  if (value == 0) return "0";
  return std::isfinite(value) ? display_text(value, unit, digits) : "no value";
}

std::string place_text(const std::vector<double>& place) { return fmt::format("({:.4g}) m", fmt::join(place, ", ")); }

template <class Difference>
std::vector<const Difference*> largest_first(const std::vector<Difference>& all) {
  std::vector<const Difference*> sorted;
  for (const Difference& difference : all) sorted.push_back(&difference);
  std::stable_sort(sorted.begin(), sorted.end(), [](const Difference* a, const Difference* b) {
    return relative(a->largest, a->scale) > relative(b->largest, b->scale);
  });
  return sorted;
}

std::string shown(TextRows rows) {
  if (rows.size() <= 1) return "";
  const std::size_t left_out = rows.size() - 1 > most_rows ? rows.size() - 1 - most_rows : 0;
  rows.resize(rows.size() - left_out);
  const std::string rest = left_out > 0 ? fmt::format("and {} with smaller differences\n", left_out) : "";
  return "\n" + text_table(rows) + rest;
}

}  // namespace

TextRows history_rows(const RunDifference& difference) {
  TextRows rows = {{"history", "largest", "at", "of its range"}};
  for (const HistoryDifference* history : largest_first(difference.histories)) {
    const ColumnName name = column_name(history->column);
    rows.push_back({name.quantity, size_text(history->largest, name.unit),
                    history->largest == 0 ? "" : duration_text(history->time),
                    share_text(relative(history->largest, history->scale))});
  }
  return rows;
}

TextRows field_rows(const RunDifference& difference) {
  TextRows rows = {{"field", "mean square", "of its range", "largest", "of its range", "at"}};
  std::vector<FieldDifference> all = difference.matrix.fields;
  all.insert(all.end(), difference.fractures.fields.begin(), difference.fractures.fields.end());
  for (const FieldDifference* field : largest_first(all)) {
    const ColumnName name = column_name(field->array);
    rows.push_back({name.quantity, size_text(field->mean_square, name.unit),
                    share_text(relative(field->mean_square, field->scale)), size_text(field->largest, name.unit),
                    share_text(relative(field->largest, field->scale)),
                    field->largest == 0 ? "" : place_text(field->where)});
  }
  return rows;
}

TextRows path_rows(const RunDifference& difference) {
  TextRows rows = {{"path", "there", "back", "sideways", "longer by", "of its length"}};
  for (const PathDifference& path : difference.paths)
    rows.push_back({difference.fracture_names[static_cast<std::size_t>(path.fracture)], size_text(path.there, "m"),
                    size_text(path.back, "m"), size_text(path.sideways, "m"), size_text(path.length, "m"),
                    share_text(relative(path.largest(), path.scale))});
  return rows;
}

TextRows cost_rows(const std::vector<ComparedRun>& runs) {
  TextRows rows = {{"run", "cells", "on fractures", "steps", "rejected", "iterations", "factorizations",
                    "processor time", "wall time"}};
  for (const ComparedRun& run : runs) {
    const RunCost& cost = run.cost;
    rows.push_back({run.name, std::to_string(cost.cells), std::to_string(cost.fracture_cells),
                    std::to_string(run.is_done ? cost.steps : static_cast<long>(run.history.row_count())),
                    std::to_string(cost.rejected), std::to_string(cost.iterations), std::to_string(cost.factorizations),
                    duration_text(cost.processor), duration_text(cost.seconds)});
    if (!run.is_done)
      for (std::size_t i = 4; i < rows.back().size(); ++i) rows.back()[i] = "–";
  }
  return rows;
}

bool is_within(const RunDifference& difference, double tolerance) {
  const std::vector<Deviation> all = deviations(difference);
  return std::all_of(all.begin(), all.end(), [&](const Deviation& one) { return one.share <= tolerance; });
}

std::string verdict(const RunDifference& difference, double tolerance) {
  const std::vector<Deviation> all = deviations(difference);
  const auto count = static_cast<std::size_t>(
      std::count_if(all.begin(), all.end(), [&](const Deviation& one) { return !(one.share <= tolerance); }));
  if (count == 0) return fmt::format("all {} differences are within {:.3g}", all.size(), tolerance);
  std::string text = fmt::format("{} of {} differences are beyond {:.3g}: ", count, all.size(), tolerance);
  for (std::size_t i = 0; i < std::min(count, most_beyond); ++i)
    text += (i > 0 ? ", " : "") + all[i].quantity + " (" +
            (std::isfinite(all[i].share) ? share_text(all[i].share) : "a value in one run only") + ")";
  return text + (count > most_beyond ? ", …" : "");
}

std::string difference_text(const std::vector<ComparedRun>& runs, const std::vector<RunDifference>& differences,
                            std::optional<double> tolerance) {
  std::string text;
  for (const RunDifference& difference : differences) {
    text += difference.other->name + " against " + difference.run->name;
    if (!difference.histories.empty()) text += ": histories until " + duration_text(difference.time.last);
    if (difference.written) text += ", fields at " + duration_text(*difference.written);
    text += "\n";
    for (const std::string& remark : difference.remarks) text += "note: " + remark + "\n";
    text += shown(history_rows(difference)) + shown(field_rows(difference)) + shown(path_rows(difference));
    if (tolerance) text += "\n" + difference.other->name + ": " + verdict(difference, *tolerance) + "\n";
    text += "\n";
  }
  return text + text_table(cost_rows(runs));
}

}  // namespace sprekk
