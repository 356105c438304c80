// Tables in CSV files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/config/input_error.hpp"

namespace sprekk {

/// Two columns of a table, with the abscissa strictly increasing.
struct Table {
  std::vector<double> abscissa, ordinate;

  double at(double abscissa_value) const;  ///< linear between the rows, constant outside
};

/// The file and columns of a table. Columns are given by name or by number from 1. With "", the abscissa is the column
/// called `of`, or else the first one, and the ordinate is the other one of two columns.
struct TableRequest {
  std::string file;  ///< as the user gave it
  std::string folder;
  std::string column;
  std::string of;                   ///< "t", "x" or "y"
  std::optional<std::string> unit;  ///< of the ordinate; absent: from a heading like "pressure[MPa]", else SI
  std::string needed_unit;
  std::string name;  ///< of the parameter
  Origin where;      ///< of the request
};

/// Comma-separated numbers below one row of headings "name" or "name[unit]" (which may be absent); lines beginning with
/// '#' are skipped. Throws InputError, with the file's line, for a cell that is not a finite number, a missing cell, or
/// an abscissa that does not increase; with the scene's line for a missing file or column.
Table read_table(const TableRequest& request);

}  // namespace sprekk
