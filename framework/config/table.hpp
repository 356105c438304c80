// Tables in CSV files.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "framework/config/input_error.hpp"

namespace sprekk {

/// Values at all combinations of the coordinates of one or more axes.
struct Table {
  std::vector<std::vector<double>> axes;  ///< the coordinates of each, strictly increasing
  std::vector<double> values;             ///< the coordinate of the last axis changes fastest

  /// `place`: a coordinate for each axis. Linear between coordinates along each axis, constant outside.
  double at(std::span<const double> place) const;
};

/// The file and columns of a table. The column of values is given by name or by number from 1; "" is the only column
/// that is no variable. Columns of variables have the names of these; of a single variable it may also be the first
/// column.
struct TableRequest {
  std::string file;  ///< as the user gave it
  std::string folder;
  std::string column;
  std::vector<std::string> of;      ///< the variables: some of "t", "x", "y", each once
  std::optional<std::string> unit;  ///< of the values; absent: from a heading like "pressure[MPa]", else SI
  std::string needed_unit;
  std::string name;  ///< of the parameter
  Origin where;      ///< of the request
};

/// Comma-separated numbers below one row of headings "name" or "name[unit]" (which may be absent); lines beginning with
/// '#' are skipped. Rows of one variable increase; rows of several variables stand in any order, one for each
/// combination of their coordinates. Throws InputError, with the file's line, for a cell that is not a finite number, a
/// missing cell, a variable that does not increase, or a combination that stands twice; with the scene's line for a
/// missing file, column or combination.
Table read_table(const TableRequest& request);

}  // namespace sprekk
