#include "framework/config/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <numeric>

#include "framework/config/csv_rows.hpp"
#include "framework/config/number.hpp"
#include "framework/config/quantity_scale.hpp"
#include "framework/config/text_file.hpp"
#include "framework/config/unit.hpp"

namespace sprekk {
namespace {

class TableReader {
 public:
  explicit TableReader(const TableRequest& request) : request_(request) {}

  Table read() {
    CsvRows csv = split_csv(content());
    if (!csv.rows.empty() || !csv.headings.empty()) require_table(csv, request_.file);
    rows_ = std::move(csv.rows);
    headings_ = std::move(csv.headings);
    if (rows_.empty() && headings_.empty()) refuse_empty("it has no row of numbers");
    columns_ = headings_.empty() ? rows_.front().cells.size() : headings_.size();
    if (rows_.empty()) refuse_empty("it has headings only");
    read_coordinates();
    const std::size_t column = value_column();
    const double scale =
        request_.unit ? scale_to_si(*request_.unit, request_.needed_unit, *request_.unit, request_.where, request_.name)
                      : column_scale(column, request_.needed_unit);
    Table table;
    for (const std::vector<double>& coordinates : coordinates_) table.axes.push_back(sorted(coordinates));
    const std::vector<std::size_t> order = rows_by_place();
    require_grid(table.axes, order);
    for (const std::size_t row : order) table.values.push_back(scale * number(rows_[row], column));
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
      if (headings_[i].name == name || headings_[i].whole == name) return i;
    }
    return std::nullopt;
  }

  /// The column of each variable, with its coordinates in SI units. One variable has to increase.
  void read_coordinates() {
    for (const std::string& variable : request_.of) {
      const std::optional<std::size_t> named = named_column(variable);
      if (!named && request_.of.size() > 1)
        throw unknown_name(request_.where, "variable of the table " + quoted(request_.file) + ":", variable, names());
      const std::size_t column = named.value_or(0);
      if (!named) require_coordinates_first(variable);
      const double scale = column_scale(column, variable == "t" ? "s" : "m");
      std::vector<double>& coordinates = coordinates_.emplace_back();
      for (const CsvRow& row : rows_) {
        const double value = scale * number(row, column);
        if (request_.of.size() == 1 && !coordinates.empty() && !(value > coordinates.back()))
          throw InputError({request_.file, row.line}, quoted(row.cells[column]) + " does not follow the row before",
                           "the column of " + variable + " must increase from row to row", "sort the rows");
        coordinates.push_back(value);
      }
      variable_columns_.push_back(column);
    }
  }

  static bool has_unit(const CsvHeading& heading) { return !heading.unit.empty() && is_unit(heading.unit); }

  /// Whether a column has the unit of a variable, or is called as the time is.
  bool may_be(const CsvHeading& heading, const std::string& variable) const {
    if (has_unit(heading)) return have_one_dimension(heading.unit, variable == "t" ? "s" : "m");
    std::string name = heading.name;
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
    return name == variable || (variable == "t" && name.find("time") != std::string::npos);
  }

  /// Refuses headings of which the first is no variable's: without the name, the first column is taken for it.
  void require_coordinates_first(const std::string& variable) const {
    if (headings_.empty() || may_be(headings_.front(), variable)) return;
    const bool is_elsewhere =
        std::ranges::any_of(headings_, [&](const CsvHeading& heading) { return may_be(heading, variable); });
    const std::string& first = headings_.front().name;
    if (!is_elsewhere && !has_unit(headings_.front()) && first != "t" && first != "x" && first != "y") return;
    throw InputError(request_.where, fmt::format("the table {} has no column '{}'", quoted(request_.file), variable),
                     "it has " + listed(names()) + ", and the first one is taken where none has this name",
                     fmt::format("call the column of {} '{}'", variable == "t" ? "the time" : variable, variable));
  }

  static std::vector<double> sorted(std::vector<double> coordinates) {
    std::sort(coordinates.begin(), coordinates.end());
    coordinates.erase(std::unique(coordinates.begin(), coordinates.end()), coordinates.end());
    return coordinates;
  }

  std::vector<double> place_of(std::size_t row) const {
    std::vector<double> place;
    for (const std::vector<double>& coordinates : coordinates_) place.push_back(coordinates[row]);
    return place;
  }

  /// The rows in the order of Table::values.
  std::vector<std::size_t> rows_by_place() const {
    std::vector<std::size_t> order(rows_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [this](std::size_t a, std::size_t b) { return place_of(a) < place_of(b); });
    return order;
  }

  /// Refuses rows that are not all combinations of the coordinates, each once.
  void require_grid(const std::vector<std::vector<double>>& axes, const std::vector<std::size_t>& order) const {
    for (std::size_t i = 1; i < order.size(); ++i)
      if (place_of(order[i]) == place_of(order[i - 1]))
        throw InputError({request_.file, rows_[order[i]].line}, place_text(place_of(order[i])) + " stands twice",
                         fmt::format("line {} has it, too", rows_[order[i - 1]].line), "remove one of the rows");
    double count = 1;
    for (const std::vector<double>& axis : axes) count *= static_cast<double>(axis.size());
    if (count == static_cast<double>(order.size())) return;
    std::size_t first = 0;  // the first combination without a row
    const auto combination = [&axes](std::size_t i) {
      std::vector<double> place(axes.size());
      for (std::size_t k = axes.size(); k-- > 0; i /= axes[k].size()) place[k] = axes[k][i % axes[k].size()];
      return place;
    };
    while (first < order.size() && place_of(order[first]) == combination(first)) ++first;
    throw InputError(request_.where, fmt::format("the table {} is no complete grid", quoted(request_.file)),
                     fmt::format("{} of {} combinations of {} have no row, the first one {}",
                                 count - static_cast<double>(order.size()), count, listed(request_.of),
                                 place_text(combination(first))),
                     "give each combination a row");
  }

  /// "x = 1 m, t = 0 s".
  std::string place_text(const std::vector<double>& place) const {
    std::string text;
    for (std::size_t k = 0; k < place.size(); ++k)
      text +=
          fmt::format("{}{} = {} {}", k == 0 ? "" : ", ", request_.of[k], place[k], request_.of[k] == "t" ? "s" : "m");
    return text;
  }

  std::size_t value_column() const {
    if (!request_.column.empty()) return wanted_column();
    if (columns_ == request_.of.size() + 1)
      for (std::size_t column = 0; column < columns_; ++column)
        if (std::ranges::count(variable_columns_, column) == 0) return column;
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

  double column_scale(std::size_t column, const std::string& needed_unit) const {
    return column < headings_.size() ? heading_scale(headings_[column], needed_unit, request_.file) : 1;
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
  std::vector<std::vector<double>> coordinates_;  ///< of each variable, row by row
  std::vector<std::size_t> variable_columns_;
};

}  // namespace

double Table::at(std::span<const double> place) const {
  // For each axis: the interval, and the weight of its upper end.
  struct Interval {
    std::size_t below;
    double share;
  };
  std::vector<Interval> intervals;
  for (std::size_t k = 0; k < axes.size(); ++k) {
    const std::vector<double>& axis = axes[k];
    const auto above = std::upper_bound(axis.begin(), axis.end(), place[k]);
    if (above == axis.begin())
      intervals.push_back({0, 0});
    else if (above == axis.end())
      intervals.push_back({axis.size() - 1, 0});
    else
      intervals.push_back(
          {static_cast<std::size_t>(above - axis.begin()) - 1, (place[k] - *(above - 1)) / (*above - *(above - 1))});
  }
  double value = 0;
  for (std::size_t corner = 0; corner < std::size_t{1} << axes.size(); ++corner) {
    std::size_t at = 0;
    double weight = 1;
    for (std::size_t k = 0; k < axes.size(); ++k) {
      const bool upper = (corner >> k & 1) != 0;
      weight *= upper ? intervals[k].share : 1 - intervals[k].share;
      at = at * axes[k].size() + intervals[k].below + (upper ? 1 : 0);
      if (weight == 0) break;  // the last interval has no upper end
    }
    if (weight != 0) value += weight * values[at];
  }
  return value;
}

Table read_table(const TableRequest& request) { return TableReader(request).read(); }

}  // namespace sprekk
