#include "framework/output/table_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

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
                         ") move it away and restart again");
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

void TableWriter::open() {
  stream_.open(file_, std::ios::binary | std::ios::app);
  if (!stream_) throw std::runtime_error("cannot write " + file_.string());
}

void TableWriter::append(double time, const Row& row) {
  if (!stream_.is_open()) open();
  if (columns_.empty()) {
    std::string header = time_column;
    for (const auto& [column, value] : row) {
      columns_.push_back(column);
      header += ',' + csv_text(column);
    }
    stream_ << header << '\n';
  }
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
  stream_ << fmt::format("{}", time);
  for (const std::string& cell : cells) stream_ << ',' << cell;
  stream_ << '\n' << std::flush;
  if (!stream_) throw std::runtime_error("cannot write " + file_.string() + " (is the disk full?)");
  ++rows_;
}

}  // namespace sprekk
