#include "framework/meshing/fracture_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <optional>

#include "framework/config/csv_rows.hpp"
#include "framework/config/number.hpp"
#include "framework/config/text_file.hpp"
#include "framework/meshing/fracture_geojson.hpp"
#include "framework/meshing/place_from_row.hpp"

namespace sprekk {
namespace {

const std::vector<std::string>& columns_of_geometry() {
  static const std::vector<std::string> known =
      dimension == 2
          ? std::vector<std::string>{"name", "size", "x1", "y1", "x2", "y2", "x", "y"}
          : std::vector<std::string>{"name", "size", "x", "y", "z", "strike", "dip", "length", "height", "radius"};
  return known;
}

bool is_geometry(const std::string& column) {
  const std::vector<std::string>& known = columns_of_geometry();
  return std::find(known.begin(), known.end(), column) != known.end();
}

/// What other programs call the columns, in small letters.
const std::map<std::string, std::string>& usual_names() {
  static const std::map<std::string, std::string> names = {
      {"start_x", "x1"}, {"start_y", "y1"}, {"end_x", "x2"}, {"end_y", "y2"}, {"x_start", "x1"},      {"y_start", "y1"},
      {"x_end", "x2"},   {"y_end", "y2"},   {"fid", "name"}, {"id", "name"},  {"fracture_id", "name"}};
  return names;
}

std::string in_small_letters(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// Calls columns as we do, where no other one is called so.
void rename_usual(std::vector<CsvHeading>& headings) {
  for (CsvHeading& heading : headings) {
    const std::string name = in_small_letters(heading.name);
    const auto usual = usual_names().find(name);
    const std::string& wanted = usual != usual_names().end() ? usual->second : name;
    if (is_geometry(wanted) && std::ranges::count(headings, wanted, &CsvHeading::name) == 0) heading.name = wanted;
  }
}

/// The table with its headings, where these stand behind a '#' above the first row.
std::string with_headings(const std::string& content) {
  const std::size_t hash = content.find_first_not_of(" \t\r\n");
  if (hash == std::string::npos || content[hash] != '#') return content;
  const std::size_t end = std::min(content.find('\n', hash), content.size());
  CsvRows first = split_csv(content.substr(hash + 1, end - hash - 1) + "\n");
  rename_usual(first.headings);
  const CsvRows rest = split_csv(content);
  const bool are_missing = rest.headings.empty() && !rest.rows.empty();
  if (!are_missing || first.headings.size() != rest.rows.front().cells.size() ||
      !std::ranges::any_of(first.headings, is_geometry, &CsvHeading::name))
    return content;
  std::string text = content;
  text[hash] = ' ';
  return text;
}

/// The column that only tables with a row for each fracture have.
const std::string is_single = dimension == 2 ? "x1" : "strike";

class TableReader {
 public:
  explicit TableReader(const FractureTable& table) : table_(table) {}

  std::vector<FractureGeometry> read() {
    const std::string text = content();
    if (is_geojson(table_.file)) return read_fracture_geojson(text, table_.file, table_.set, table_.where);
    csv_ = split_csv(with_headings(text));
    rename_usual(csv_.headings);
    if (csv_.headings.empty())
      throw refused("has no headings", "its columns are known by them",
                    std::string("begin it with the line '") +
                        (dimension == 2 ? "x1,y1,x2,y2'" : "x,y,z,strike[deg],dip[deg],radius'"));
    require_table(csv_, table_.file);
    check_columns();
    if (csv_.rows.empty()) throw refused("has headings only", "it needs a row for each fracture or point", "add rows");
    return find(is_single) ? singles() : of_points();
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
    if (dimension == 3) return check_columns_in_space();
    const bool has_ends = find("x1") && find("y1") && find("x2") && find("y2");
    const bool has_points = find("name") && find("x") && find("y");
    if (has_ends != has_points) return;
    throw refused(has_ends ? "has ends and points" : "lacks columns",
                  "straight fractures have x1, y1, x2, y2, and points of polylines have name, x, y",
                  "give it one of the two sets of columns");
  }

  void check_columns_in_space() const {
    const auto has = [this](std::initializer_list<const char*> names) {
      return std::ranges::all_of(names, [this](const char* name) { return find(name).has_value(); });
    };
    const bool has_plane = has({"x", "y", "z", "strike", "dip"}),
               has_points = has({"name", "x", "y", "z"}) && !find("strike");
    const bool is_sized = has({"length", "height"}) != has({"radius"});
    if ((has_plane && is_sized) || (has_points && !find("dip"))) return;
    const bool has_both = has({"length", "height", "radius"});
    throw refused(
        has_both ? "has columns of rectangles and of discs" : "lacks columns",
        "fractures have x, y, z, strike, dip and either length, height or radius, and points of polygons have "
        "name, x, y, z",
        "give it one of these sets of columns");
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
    return number(row, name) * heading_scale(heading, "m", table_.file);
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

  /// Fractures with a row each.
  std::vector<FractureGeometry> singles() const {
    std::vector<FractureGeometry> fractures;
    for (const CsvRow& row : csv_.rows) {
      const std::string number = fmt::format("{}_{}", table_.set, fractures.size() + 1);
      fractures.push_back(fracture(row, find("name") ? cell(row, "name") : number));
      const auto value = [&](const std::string& column, const std::string& unit) {
        return this->number(row, column) * heading_scale(csv_.headings[*find(column)], unit, table_.file);
      };
      place_from_row(
          value, [this](const std::string& column) { return find(column).has_value(); }, fractures.back());
    }
    return fractures;
  }

  Point point(const CsvRow& row) const {
    Point point;
    for (int axis = 0; axis < dimension; ++axis) point[axis] = length(row, std::string(1, "xyz"[axis]));
    return point;
  }

  /// Refuses a row of a polyline that has other values than its first row: there is one value for a fracture.
  void require_same(const FractureGeometry& first, const FractureGeometry& row) const {
    const auto refuse = [&](const std::string& column) {
      throw InputError(row.origin, fmt::format("fracture '{}' has two values of {}", first.name, column),
                       "the other one is at " + first.origin.text(), "repeat the first one in all rows of a fracture");
    };
    if (row.size != first.size) refuse("size");
    for (std::size_t i = 0; i < row.values.size(); ++i)
      if (row.values[i].value != first.values[i].value) refuse(row.values[i].column);
  }

  /// Polylines, or polygons, with a row for each point.
  std::vector<FractureGeometry> of_points() const {
    std::vector<FractureGeometry> fractures;
    for (const CsvRow& row : csv_.rows) {
      const std::string& name = cell(row, "name");
      const FractureGeometry read = fracture(row, name);
      if (fractures.empty() || fractures.back().name != name)
        fractures.push_back(read);
      else
        require_same(fractures.back(), read);
      fractures.back().points.push_back(point(row));
    }
    return fractures;
  }

  const FractureTable& table_;
  CsvRows csv_;
};

}  // namespace

std::vector<FractureGeometry> read_fracture_table(const FractureTable& table) {
  std::vector<FractureGeometry> fractures = TableReader(table).read();
  for (FractureGeometry& fracture : fractures) {
    for (Point& point : fracture.points) point -= table.origin;
    if (fracture.ellipse) fracture.ellipse->center -= table.origin;
  }
  return fractures;
}

void require_used_columns(const std::vector<FractureGeometry>& fractures, const std::set<std::string>& used) {
  for (const FractureGeometry& fracture : fractures)
    for (const ColumnValue& value : fracture.values)
      if (used.count(value.column) == 0 && !is_geojson(value.where.source))
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
