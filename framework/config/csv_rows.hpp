// The rows of a CSV file as texts.
#pragma once

#include <string>
#include <vector>

namespace sprekk {

/// The cells of a row.
struct CsvRow {
  int line = 0;  ///< in the file, from 1
  std::vector<std::string> cells;
};

/// A heading "name", or one with a unit: "name[unit]", "name (unit)", "name {unit}", "name / unit".
struct CsvHeading {
  std::string name;
  std::string unit;   ///< as it is written, it may be none; "" without one
  std::string whole;  ///< as it is written
};

/// The parts of a heading as it is written.
CsvHeading heading_of(const std::string& cell);

/// Headings are the first row, if none of its cells is a number; else there are none.
struct CsvRows {
  std::vector<CsvHeading> headings;
  std::vector<CsvRow> rows;
};

/// The rows of comma-separated cells without the white space and the quotes around them; empty lines and lines that
/// begin with '#' are skipped.
CsvRows split_csv(const std::string& content);

/// The factor to SI units of a column whose quantity has the SI unit `needed`. Throws InputError where the heading has
/// another unit, or something that is none. `file` is for messages.
double heading_scale(const CsvHeading& heading, const std::string& needed, const std::string& file);

/// Refuses two headings of one name, and a row that holds more than there are columns. `file` is for messages.
void require_table(const CsvRows& csv, const std::string& file);

}  // namespace sprekk
