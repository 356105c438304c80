#include "framework/config/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "framework/config/csv_rows.hpp"
#include "framework/config/number.hpp"
#include "framework/config/quantity_scale.hpp"
#include "framework/config/text_file.hpp"

namespace sprekk {
namespace {

class TableReader {
 public:
  explicit TableReader(const TableRequest& request) : request_(request) {}

  Table read() {
    CsvRows csv = split_csv(content());
    rows_ = std::move(csv.rows);
    headings_ = std::move(csv.headings);
    if (rows_.empty() && headings_.empty()) refuse_empty("it has no row of numbers");
    columns_ = headings_.empty() ? rows_.front().cells.size() : headings_.size();
    if (rows_.empty()) refuse_empty("it has headings only");
    const std::size_t abscissa = abscissa_column();
    const std::size_t ordinate = ordinate_column(abscissa);
    const double abscissa_scale = heading_scale(abscissa, request_.of == "t" ? "s" : "m");
    const double ordinate_scale =
        request_.unit ? scale_to_si(*request_.unit, request_.needed_unit, *request_.unit, request_.where, request_.name)
                      : heading_scale(ordinate, request_.needed_unit);
    Table table;
    for (const CsvRow& row : rows_) {
      const double value = abscissa_scale * number(row, abscissa);
      if (!table.abscissa.empty() && !(value > table.abscissa.back())) {
        throw InputError({request_.file, row.line}, quoted(row.cells[abscissa]) + " does not follow the row before",
                         "the column of " + request_.of + " must increase from row to row", "sort the rows");
      }
      table.abscissa.push_back(value);
      table.ordinate.push_back(ordinate_scale * number(row, ordinate));
    }
    return table;
  }

 private:
  [[noreturn]] void refuse_empty(const std::string& why) const {
    throw InputError(request_.where, "the table " + quoted(request_.file) + " is empty", why,
                     "give it a row for each value");
  }

  std::string content() const {
    const std::filesystem::path path = std::filesystem::path(request_.folder) / request_.file;
    try {
      return read_text_file(path.string(), request_.file);
    } catch (const InputError& error) {
      throw InputError(request_.where, "the table " + quoted(request_.file) + " cannot be used", error.what(),
                       "tables are looked for beside the scene file");
    }
  }

  std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const CsvHeading& heading : headings_) result.push_back(heading.name);
    return result;
  }

  std::optional<std::size_t> named_column(const std::string& name) const {
    for (std::size_t i = 0; i < headings_.size(); ++i) {
      if (headings_[i].name == name) return i;
    }
    return std::nullopt;
  }

  std::size_t abscissa_column() const { return named_column(request_.of).value_or(0); }

  std::size_t ordinate_column(std::size_t abscissa) const {
    if (!request_.column.empty()) return wanted_column();
    if (columns_ == 2) return 1 - abscissa;
    throw InputError(
        request_.where, fmt::format("'column' is missing for the table {}", quoted(request_.file)),
        fmt::format("the table has {} columns{}{}", columns_, headings_.empty() ? "" : ": ", listed(names())),
        "add 'column: <name or number from 1>'");
  }

  std::size_t wanted_column() const {
    const std::string& wanted = request_.column;
    if (const auto column = named_column(wanted)) return *column;
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
    if (error != std::errc{} || end != wanted.data() + wanted.size()) {
      throw unknown_name(request_.where, "column of the table " + quoted(request_.file) + ":", wanted, names());
    }
    if (number >= 1 && number <= columns_) return number - 1;
    throw InputError(request_.where, fmt::format("the table {} has no column {}", quoted(request_.file), number),
                     fmt::format("its columns are 1 to {}", columns_));
  }

  double heading_scale(std::size_t column, const std::string& needed_unit) const {
    if (column >= headings_.size() || headings_[column].unit.empty()) return 1;
    return scale_to_si(headings_[column].unit, needed_unit, headings_[column].unit, {request_.file, 1},
                       headings_[column].name);
  }

  double number(const CsvRow& row, std::size_t column) const {
    if (column >= row.cells.size()) {
      throw InputError({request_.file, row.line}, fmt::format("the row has no column {}", column + 1),
                       fmt::format("it has {}", row.cells.size()));
    }
    const auto value = leading_number(row.cells[column]);
    if (value && value->length == row.cells[column].size() && value->is_finite) return value->value;
    throw InputError({request_.file, row.line},
                     fmt::format("{} in column {} is not a finite number", quoted(row.cells[column]), column + 1),
                     "units stand in the heading, like p[MPa]");
  }

  const TableRequest& request_;
  std::vector<CsvRow> rows_;
  std::size_t columns_ = 0;
  std::vector<CsvHeading> headings_;
};

}  // namespace

double Table::at(double abscissa_value) const {
  const auto above = std::upper_bound(abscissa.begin(), abscissa.end(), abscissa_value);
  if (above == abscissa.begin()) return ordinate.front();
  if (above == abscissa.end()) return ordinate.back();
  const auto i = static_cast<std::size_t>(above - abscissa.begin());
  const double weight = (abscissa_value - abscissa[i - 1]) / (abscissa[i] - abscissa[i - 1]);
  return (1 - weight) * ordinate[i - 1] + weight * ordinate[i];
}

Table read_table(const TableRequest& request) { return TableReader(request).read(); }

}  // namespace sprekk
