#include "framework/results/csv_table.hpp"

#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

namespace sprekk {
namespace {

/// One line in its cells, quoted as RFC 4180 says.
std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells(1);
  bool is_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool is_doubled = line[i] == '"' && is_quoted && i + 1 < line.size() && line[i + 1] == '"';
    if (is_doubled) {
      cells.back() += line[++i];
    } else if (line[i] == '"') {
      is_quoted = !is_quoted;
    } else if (line[i] == ',' && !is_quoted) {
      cells.emplace_back();
    } else if (line[i] != '\r') {
      cells.back() += line[i];
    }
  }
  return cells;
}

double number(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return end == text.c_str() || *end != '\0' ? std::numeric_limits<double>::quiet_NaN() : value;
}

}  // namespace

CsvTable::CsvTable(const std::string& text) {
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    std::vector<std::string> cells = split(text.substr(begin, end - begin));
    if (begin == 0)
      columns_ = std::move(cells);
    else if (cells.size() == columns_.size())
      rows_.push_back(std::move(cells));
  }
}

CsvTable CsvTable::read(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (stream) text << stream.rdbuf();
  return CsvTable(text.str());
}

int CsvTable::find(const std::string& column) const {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const std::string& name = columns_[i];
    const bool is_without_unit = name.rfind(column + "[", 0) == 0 && name.find('[') == column.size();
    if (name == column || is_without_unit) return static_cast<int>(i);
  }
  return -1;
}

std::vector<std::string> CsvTable::texts(int column) const {
  std::vector<std::string> values;
  for (const auto& row : rows_) values.push_back(row.at(static_cast<std::size_t>(column)));
  return values;
}

std::vector<double> CsvTable::numbers(int column) const {
  std::vector<double> values;
  for (const auto& row : rows_) values.push_back(number(row.at(static_cast<std::size_t>(column))));
  return values;
}

std::vector<double> CsvTable::numbers(const std::string& column) const {
  const int place = find(column);
  return place < 0 ? std::vector<double>() : numbers(place);
}

}  // namespace sprekk
