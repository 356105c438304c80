#include "framework/config/csv_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "framework/config/input_error.hpp"
#include "framework/config/number.hpp"

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
  for (const std::string& cell : row.cells) {
    const std::size_t bracket = cell.find('[');
    if (bracket == std::string::npos || cell.back() != ']') {
      headings.push_back({cell, ""});
    } else {
      headings.push_back({trimmed(cell.substr(0, bracket)), cell.substr(bracket + 1, cell.size() - bracket - 2)});
    }
  }
  return headings;
}

}  // namespace

CsvRows split_csv(const std::string& content) {
  CsvRows csv{{}, split_rows(content)};
  if (csv.rows.empty()) return csv;
  const std::vector<std::string>& first = csv.rows.front().cells;
  if (std::any_of(first.begin(), first.end(), is_number)) return csv;
  csv.headings = headings_of(csv.rows.front());
  csv.rows.erase(csv.rows.begin());
  return csv;
}

void require_table(const CsvRows& csv, const std::string& file) {
  const std::size_t columns = csv.headings.empty() ? csv.rows.front().cells.size() : csv.headings.size();
  for (std::size_t i = 0; i < csv.headings.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!csv.headings[i].name.empty() && csv.headings[i].name == csv.headings[j].name)
        throw InputError({file, 1}, "two columns are called " + quoted(csv.headings[i].name),
                         fmt::format("columns {} and {}", j + 1, i + 1), "give each column a name of its own");
  for (const CsvRow& row : csv.rows)
    for (std::size_t i = columns; i < row.cells.size(); ++i)
      if (!row.cells[i].empty())
        throw InputError({file, row.line}, fmt::format("the row has {} cells", row.cells.size()),
                         fmt::format("the table has {} columns", columns),
                         "commas separate cells: write decimals with a point");
}

}  // namespace sprekk
