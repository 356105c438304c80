// One number of a run, for a study's table: a value at a time, the time of a value, or an extreme.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/config/spec.hpp"
#include "framework/results/csv_table.hpp"

namespace sprekk {

/// The parameters of a figure in the file of a study.
struct FigureOptions {
  std::string name;
  Origin origin;
  std::string of;                      ///< a column of history.csv, with or without its unit
  std::optional<std::string> at;       ///< "end" or a time
  std::optional<std::string> reaches;  ///< a value with its unit
  std::string take;
  Origin of_origin, at_origin, reaches_origin;
  Spec spec();
};

/// Columns as "quantity[unit]".
using ColumnNames = std::vector<std::string>;

/// The column of `names` that is meant by "quantity" or "quantity[unit]". Throws InputError with the nearest name.
std::string find_column(const ColumnNames& names, const std::string& wanted, const Origin& where);

/// A figure with its column in the history, and so with its unit.
class Figure {
 public:
  /// Throws InputError for an unknown column, and for a time or value of the wrong dimension.
  Figure(const FigureOptions& options, const ColumnNames& columns);

  const std::string& name() const { return name_; }
  const std::string& unit() const { return unit_; }  ///< SI, of the figure; "" for a plain number
  std::string heading() const;                       ///< "time to 0.1 m[s]"
  /// The figure of a run; NaN when its history has no such value. Between rows the history is linear in time; means and
  /// integrals use the value of each row for its whole step, as the time stepping does.
  double of(const CsvTable& history) const;

 private:
  std::string name_, column_, unit_, take_;
  std::optional<double> time_, level_;
};

}  // namespace sprekk
