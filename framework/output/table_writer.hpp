// Tables that grow row by row: history.csv (a row per accepted step) and coupling.csv (a row per iteration).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "framework/output/plain_file.hpp"

namespace sprekk {

/// A CSV file whose first column is time[s]. Numbers have as many digits as are needed to read the same bits (17 at
/// most). Every row is written at once, so that it survives a crash. Symbolic links are not followed.
class TableWriter {
 public:
  using Value = std::variant<double, std::string>;
  using Row = std::vector<std::pair<std::string, Value>>;  ///< column "quantity[unit]", value

  /// A new table; the file appears with the first row, which also fixes the columns.
  explicit TableWriter(std::filesystem::path file) : file_(std::move(file)) {}

  /// Continues the table in `file` after its first `rows` rows; later rows, and a last row that was cut short, are
  /// removed. Without `rows`, rows later than `time` (s) are removed. A missing file is a new table when no row is
  /// expected. Throws InputError if the file is missing, is a link, has fewer rows, or is not a table with a time
  /// column.
  static TableWriter continued(std::filesystem::path file, double time, std::optional<long> rows = std::nullopt);

  /// The columns of a table without time[s]; empty if there is none.
  static std::vector<std::string> columns_of(const std::filesystem::path& file);

  /// Adds a row; columns that the row lacks stay empty. Where the file has been removed meanwhile, a new one begins
  /// (loss). Throws std::logic_error for a column that the table does not have, std::runtime_error when the file
  /// cannot be written, or when another one has taken its place.
  void append(double time, const Row& row);

  const std::vector<std::string>& columns() const { return columns_; }
  long rows() const { return rows_; }  ///< in the file
  /// What to tell the user of files that were removed while the run wrote them; empty if none was.
  std::string loss() const;

 private:
  void look_for_file();
  std::string header() const;

  std::filesystem::path file_;
  std::optional<PlainFile> open_file_;
  std::vector<std::string> columns_;  ///< without time[s]; empty until there is a row
  long rows_ = 0, lost_rows_ = 0;
};

}  // namespace sprekk
