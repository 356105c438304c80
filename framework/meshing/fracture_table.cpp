#include "framework/meshing/fracture_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "framework/config/csv_rows.hpp"
#include "framework/config/number.hpp"
#include "framework/config/quantity_scale.hpp"
#include "framework/config/text_file.hpp"

namespace sprekk {
namespace {

const std::vector<std::string>& columns_of_geometry() {
  static const std::vector<std::string> known = {"name", "size", "x1", "y1", "x2", "y2", "x", "y"};
  return known;
}

bool is_geometry(const std::string& column) {
  const std::vector<std::string>& known = columns_of_geometry();
  return std::find(known.begin(), known.end(), column) != known.end();
}

class Reader {
 public:
  explicit Reader(const FractureTable& table) : table_(table) {}

  std::vector<FractureGeometry> read() {
    csv_ = split_csv(content());
    if (csv_.headings.empty())
      throw refused("has no headings", "its columns are known by them", "begin it with the line 'x1,y1,x2,y2'");
    check_columns();
    if (csv_.rows.empty()) throw refused("has headings only", "it needs a row for each fracture or point", "add rows");
    return find("x1") ? segments() : polylines();
  }

 private:
  InputError refused(const std::string& what, const std::string& why, const std::string& advice) const {
    return InputError(table_.where, fmt::format("the table '{}' {}", table_.file, what), why, advice);
  }

  std::string content() const {
    const std::filesystem::path path = std::filesystem::path(table_.folder) / table_.file;
    try {
      return read_text_file(path.string(), table_.file);
    } catch (const InputError& error) {
      throw refused("cannot be used", error.what(), "tables are looked for beside the scene file");
    }
  }

  void check_columns() const {
    const bool has_ends = find("x1") && find("y1") && find("x2") && find("y2");
    const bool has_points = find("name") && find("x") && find("y");
    if (has_ends != has_points) return;
    throw refused(has_ends ? "has ends and points" : "lacks columns",
                  "straight fractures have x1, y1, x2, y2, and points of polylines have name, x, y",
                  "give it one of the two sets of columns");
  }

  std::optional<std::size_t> find(const std::string& name) const {
    for (std::size_t i = 0; i < csv_.headings.size(); ++i)
      if (csv_.headings[i].name == name) return i;
    return std::nullopt;
  }

  const std::string& cell(const CsvRow& row, const std::string& name) const {
    const std::size_t column = *find(name);
    if (column < row.cells.size() && !row.cells[column].empty()) return row.cells[column];
    throw InputError({table_.file, row.line}, fmt::format("the row has no {}", name),
                     fmt::format("it has {} of {} cells", row.cells.size(), csv_.headings.size()));
  }

  double number(const CsvRow& row, const std::string& name) const {
    const std::string& text = cell(row, name);
    const auto value = leading_number(text);
    if (!value || value->length != text.size() || !value->is_finite)
      throw InputError({table_.file, row.line}, fmt::format("'{}' for {} is not a finite number", text, name),
                       "units stand in the heading, like x1[mm]");
    return value->value;
  }

  double length(const CsvRow& row, const std::string& name) const {
    const CsvHeading& heading = csv_.headings[*find(name)];
    const double scale =
        heading.unit.empty() ? 1 : scale_to_si(heading.unit, "m", heading.unit, {table_.file, 1}, name);
    return number(row, name) * scale;
  }

  FractureGeometry fracture(const CsvRow& row, const std::string& name) const {
    FractureGeometry fracture{name, {}, std::nullopt, {table_.file, row.line}};
    if (find("size")) fracture.size = length(row, "size");
    if (fracture.size && !(*fracture.size > 0))
      throw InputError({table_.file, row.line}, fmt::format("the size {} is not positive", *fracture.size),
                       "it is the length of cells");
    for (const CsvHeading& heading : csv_.headings)
      if (!is_geometry(heading.name))
        fracture.values.push_back(
            {heading.name, heading.unit, number(row, heading.name), Origin{table_.file, row.line}});
    return fracture;
  }

  std::vector<FractureGeometry> segments() const {
    std::vector<FractureGeometry> fractures;
    for (const CsvRow& row : csv_.rows) {
      const std::string number = fmt::format("{}_{}", table_.set, fractures.size() + 1);
      fractures.push_back(fracture(row, find("name") ? cell(row, "name") : number));
      fractures.back().points = {Point(length(row, "x1"), length(row, "y1")),
                                 Point(length(row, "x2"), length(row, "y2"))};
    }
    return fractures;
  }

  std::vector<FractureGeometry> polylines() const {
    std::vector<FractureGeometry> fractures;
    for (const CsvRow& row : csv_.rows) {
      const std::string& name = cell(row, "name");
      if (fractures.empty() || fractures.back().name != name) fractures.push_back(fracture(row, name));
      fractures.back().points.push_back(Point(length(row, "x"), length(row, "y")));
    }
    return fractures;
  }

  const FractureTable& table_;
  CsvRows csv_;
};

}  // namespace

std::vector<FractureGeometry> read_fracture_table(const FractureTable& table) { return Reader(table).read(); }

void require_used_columns(const std::vector<FractureGeometry>& fractures, const std::set<std::string>& used) {
  for (const FractureGeometry& fracture : fractures)
    for (const ColumnValue& value : fracture.values)
      if (used.count(value.column) == 0)
        throw unknown_name({value.where.source, 1},
                           "column of the table of fractures, which no datum takes either:", value.column,
                           columns_of_geometry());
}

void expand_fracture_table(Node& geometry) {
  for (Node::Entry& section : geometry.entries) {
    if (section.key != "fractures") continue;
    for (Node::Entry& entry : section.value.entries) {
      if (entry.key != "table" || !entry.value.is_scalar()) continue;
      Node file = entry.value;
      file.path += ".table";
      entry.value.kind = Node::Kind::map;
      entry.value.scalar.clear();
      entry.value.entries = {{"table", entry.origin, std::move(file)}};
    }
  }
}

}  // namespace sprekk
