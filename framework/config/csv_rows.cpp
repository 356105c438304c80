#include "framework/config/csv_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "framework/config/input_error.hpp"
#include "framework/config/number.hpp"
#include "framework/config/quantity_scale.hpp"
#include "framework/config/unit.hpp"

namespace sprekk {
namespace {

CsvRow split_row(const std::string& text, int line) {
  CsvRow row{line, {}};
  std::istringstream stream(text + ",");
  for (std::string cell; std::getline(stream, cell, ',');) {
    cell = trimmed(cell);
    const bool in_quotes = cell.size() >= 2 && cell.front() == '"' && cell.back() == '"';
    row.cells.push_back(in_quotes ? trimmed(cell.substr(1, cell.size() - 2)) : cell);
  }
  return row;
}

std::vector<CsvRow> split_rows(const std::string& content) {
  std::vector<CsvRow> rows;
  std::istringstream stream(content);
  int line = 0;
  for (std::string text; std::getline(stream, text);) {
    ++line;
    if (line == 1 && text.rfind("\xEF\xBB\xBF", 0) == 0) text.erase(0, 3);  // byte order mark
    text = trimmed(text);
    if (!text.empty() && text[0] != '#') rows.push_back(split_row(text, line));
  }
  return rows;
}

bool is_number(const std::string& cell) {
  const auto number = leading_number(cell);
  return number && number->length == cell.size();
}

std::vector<CsvHeading> headings_of(const CsvRow& row) {
  std::vector<CsvHeading> headings;
  for (const std::string& cell : row.cells) headings.push_back(heading_of(cell));
  return headings;
}

/// What tells columns apart: the whole heading where its unit is none.
const std::string& name_of(const CsvHeading& heading) {
  return heading.unit.empty() || is_unit(heading.unit) ? heading.name : heading.whole;
}

/// Refuses a table with one column whose cells hold another separator.
void require_commas(const CsvRows& csv, const std::string& file) {
  const bool has_headings = !csv.headings.empty();
  const std::string first = has_headings ? csv.headings.front().whole : csv.rows.front().cells.front();
  const std::size_t columns = has_headings ? csv.headings.size() : csv.rows.front().cells.size();
  for (const auto& [separator, name] : {std::pair(';', "';'"), std::pair('\t', "a tab")})
    if (columns == 1 && first.find(separator) != std::string::npos)
      throw InputError({file, has_headings ? 1 : csv.rows.front().line}, fmt::format("{} separates the columns", name),
                       "cells are separated by commas, and decimals have a point", "write the table with commas");
}

}  // namespace

CsvHeading heading_of(const std::string& cell) {
  for (const auto& [open, close] : {std::pair('[', ']'), std::pair('(', ')'), std::pair('{', '}')}) {
    const std::size_t bracket = cell.find(open);
    if (bracket != std::string::npos && cell.back() == close)
      return {trimmed(cell.substr(0, bracket)), trimmed(cell.substr(bracket + 1, cell.size() - bracket - 2)), cell};
  }
  const std::size_t slash = cell.find('/');
  if (slash == std::string::npos) return {cell, "", cell};
  return {trimmed(cell.substr(0, slash)), trimmed(cell.substr(slash + 1)), cell};
}

CsvRows split_csv(const std::string& content) {
  CsvRows csv{{}, split_rows(content)};
  if (csv.rows.empty()) return csv;
  const std::vector<std::string>& first = csv.rows.front().cells;
  if (std::any_of(first.begin(), first.end(), is_number)) return csv;
  csv.headings = headings_of(csv.rows.front());
  csv.rows.erase(csv.rows.begin());
  return csv;
}

double heading_scale(const CsvHeading& heading, const std::string& needed, const std::string& file) {
  if (heading.unit.empty()) return 1;
  const Origin where{file, 1};
  if (is_unit(heading.unit) || heading.whole.back() == ']')
    return scale_to_si(heading.unit, needed, heading.unit, where, heading.name);
  const std::string nearest = nearest_unit(heading.unit);
  const std::string meant = have_one_dimension(nearest, needed) ? nearest : needed;
  throw InputError(where, quoted(heading.unit) + " in the heading " + quoted(heading.whole) + " is no unit",
                   "what stands in brackets or behind '/' is taken for the unit of the column",
                   needed.empty() ? "give the column a name without it"
                                  : "write " + quoted(heading.name + "[" + meant + "]") + ", or a name without it");
}

void require_table(const CsvRows& csv, const std::string& file) {
  require_commas(csv, file);
  const std::size_t columns = csv.headings.empty() ? csv.rows.front().cells.size() : csv.headings.size();
  for (std::size_t i = 0; i < csv.headings.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!name_of(csv.headings[i]).empty() && name_of(csv.headings[i]) == name_of(csv.headings[j]))
        throw InputError({file, 1}, "two columns are called " + quoted(name_of(csv.headings[i])),
                         fmt::format("columns {} and {}", j + 1, i + 1), "give each column a name of its own");
  for (const CsvRow& row : csv.rows)
    for (std::size_t i = columns; i < row.cells.size(); ++i)
      if (!row.cells[i].empty())
        throw InputError({file, row.line}, fmt::format("the row has {} cells", row.cells.size()),
                         fmt::format("the table has {} columns", columns),
                         "commas separate cells: write decimals with a point");
}

}  // namespace sprekk
