// Tables that runs have written (history.csv, coupling.csv), read back.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sprekk {

/// A table of texts and numbers with named columns.
class CsvTable {
 public:
  CsvTable() = default;
  /// Reads comma-separated text with one row of headings; a last row that was cut short is left out.
  explicit CsvTable(const std::string& text);
  /// A missing or unreadable file is a table without columns.
  static CsvTable read(const std::filesystem::path& file);

  const std::vector<std::string>& columns() const { return columns_; }
  std::size_t row_count() const { return rows_.size(); }

  /// The place of a column given as "quantity[unit]" or as "quantity" alone; -1 when there is none.
  int find(const std::string& column) const;
  /// The values of a column; NaN where a cell is empty or is no number.
  std::vector<double> numbers(int column) const;
  std::vector<std::string> texts(int column) const;
  /// The values of a column, or nothing when there is none.
  std::vector<double> numbers(const std::string& column) const;

 private:
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace sprekk
