#include "framework/output/table_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "framework/config/input_error.hpp"
#include "framework/output/atomic_file.hpp"

namespace sprekk {
namespace {

const std::string time_column = "time[s]";

/// Quoted as RFC 4180 asks; line breaks become spaces, so that a row is a line.
std::string csv_text(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  if (text.find_first_of(",\"") == std::string::npos) return text;
  for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2) text.insert(at, 1, '"');
  return '"' + text + '"';
}

std::string csv_value(const TableWriter::Value& value) {
  // Unknown values (NaN) have an empty cell.
  if (const double* number = std::get_if<double>(&value))
    return std::isnan(*number) ? std::string() : fmt::format("{}", *number);
  return csv_text(std::get<std::string>(value));
}

std::vector<std::string> split_row(const std::string& line) {
  std::vector<std::string> values(1);
  bool is_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') {
      if (is_quoted && i + 1 < line.size() && line[i + 1] == '"')
        values.back() += line[++i];
      else
        is_quoted = !is_quoted;
    } else if (line[i] == ',' && !is_quoted) {
      values.emplace_back();
    } else {
      values.back() += line[i];
    }
  }
  return values;
}

}  // namespace

TableWriter TableWriter::continued(std::filesystem::path file, double time, std::optional<long> rows) {
  TableWriter table(std::move(file));
  std::error_code error;
  if (std::filesystem::is_symlink(table.file_, error))
    throw InputError("cannot continue " + table.file_.string() + " (it is a symbolic link, which may lead out of the " +
                     "folder) put the table itself there");
  std::ifstream old(table.file_, std::ios::binary);
  if (!old) {
    if (!rows || *rows == 0) return table;
    throw InputError("cannot continue " + table.file_.string() + " (it is missing or cannot be read, and the run has " +
                     "written " + std::to_string(*rows) + " rows) put it back, or start the scene anew with -o");
  }
  std::ostringstream content;
  content << old.rdbuf();
  const std::string text = content.str();

  std::string kept;
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const std::string line = text.substr(begin, end - begin);
    if (begin == 0) {
      table.columns_ = split_row(line);
      if (table.columns_.front() != time_column)
        throw InputError("cannot continue " + table.file_.string() + " (its first column is not " + time_column +
                         ") put the table of the run back, or start the scene anew with -o");
      table.columns_.erase(table.columns_.begin());
    } else {
      if (rows ? table.rows_ >= *rows : std::strtod(line.c_str(), nullptr) > time) continue;
      ++table.rows_;
    }
    kept += line + '\n';
  }
  if (rows && table.rows_ < *rows)
    throw InputError("cannot continue " + table.file_.string() + " (it has " + std::to_string(table.rows_) +
                     " rows, and the run has written " + std::to_string(*rows) +
                     ") put the whole table back, or start the scene anew with -o");
  if (kept.size() != text.size()) write_atomically(table.file_, kept);
  return table;
}

std::vector<std::string> TableWriter::columns_of(const std::filesystem::path& file) {
  std::ifstream table(file, std::ios::binary);
  std::string header;
  if (!table || !std::getline(table, header)) return {};
  std::vector<std::string> columns = split_row(header);
  columns.erase(columns.begin());
  return columns;
}

std::string TableWriter::header() const {
  std::string header = time_column;
  for (const std::string& column : columns_) header += ',' + csv_text(column);
  return header + '\n';
}

void TableWriter::look_for_file() {
  if (!open_file_ || open_file_->has_name(file_)) return;
  std::error_code error;
  if (std::filesystem::symlink_status(file_, error).type() != std::filesystem::file_type::not_found)
    throw std::runtime_error("another file has taken its place, and nothing is overwritten");
  open_file_.reset();
  lost_rows_ += std::exchange(rows_, 0);
}

std::string TableWriter::loss() const {
  if (lost_rows_ == 0) return "";
  const std::string name = file_.filename().string();
  return fmt::format(
      "{} was removed while the run wrote it, with {} rows (a new one has begun) copy what is needed "
      "elsewhere, and leave it where it is until the run has ended",
      name, lost_rows_);
}

void TableWriter::append(double time, const Row& row) {
  if (columns_.empty())
    for (const auto& [column, value] : row) columns_.push_back(column);
  std::vector<std::string> cells(columns_.size());
  for (std::size_t i = 0; i < row.size(); ++i) {
    const auto& [column, value] = row[i];
    // Rows mostly keep their order, so the place of a value is usually its number.
    const auto found = i < columns_.size() && columns_[i] == column
                           ? columns_.begin() + static_cast<std::ptrdiff_t>(i)
                           : std::find(columns_.begin(), columns_.end(), column);
    if (found == columns_.end()) throw std::logic_error(file_.string() + " has no column " + column);
    cells[found - columns_.begin()] = csv_value(value);
  }
  std::string text = fmt::format("{}", time);
  for (const std::string& cell : cells) text += ',' + cell;
  text += '\n';
  try {
    look_for_file();
    // Without a row, a file holds no more than one that was cut short.
    const bool is_new = rows_ == 0 && !open_file_;
    if (!open_file_) open_file_.emplace(file_, is_new ? PlainFile::Mode::anew : PlainFile::Mode::append);
    open_file_->write(is_new ? header() + text : text);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error("cannot write " + file_.string() + " (" + error.what() + ")");
  }
  ++rows_;
}

}  // namespace sprekk
