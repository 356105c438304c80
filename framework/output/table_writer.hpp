// Tables that grow row by row: history.csv (a row per accepted step) and coupling.csv (a row per iteration).
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sprekk {

/// A CSV file whose first column is time[s]. Numbers have as many digits as are needed to read the same bits (17 at
/// most). Every row is flushed, so that it survives a crash.
class TableWriter {
 public:
  using Value = std::variant<double, std::string>;
  using Row = std::vector<std::pair<std::string, Value>>;  ///< column "quantity[unit]", value

  /// A new table; the file appears with the first row, which also fixes the columns.
  explicit TableWriter(std::filesystem::path file) : file_(std::move(file)) {}

  /// Continues the table in `file` after its first `rows` rows; later rows, and a last row that was cut short, are
  /// removed. Without `rows`, rows later than `time` (s) are removed. A missing file is a new table when no row is
  /// expected. Throws InputError if the file is missing, has fewer rows, or is not a table with a time column.
  static TableWriter continued(std::filesystem::path file, double time, std::optional<long> rows = std::nullopt);

  /// The columns of a table without time[s]; empty if there is none.
  static std::vector<std::string> columns_of(const std::filesystem::path& file);

  /// Adds a row; columns that the row lacks stay empty. Throws std::logic_error for a column that the table does not
  /// have, std::runtime_error when the file cannot be written.
  void append(double time, const Row& row);

  const std::vector<std::string>& columns() const { return columns_; }
  long rows() const { return rows_; }

 private:
  void open();

  std::filesystem::path file_;
  std::ofstream stream_;
  std::vector<std::string> columns_;  ///< without time[s]; empty until there is a row
  long rows_ = 0;
};

}  // namespace sprekk
