#include "framework/meshing/fracture_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "framework/config/csv_rows.hpp"
#include "framework/config/number.hpp"
#include "framework/config/text_file.hpp"
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

/// The column that only tables with a row for each fracture have.
const std::string is_single = dimension == 2 ? "x1" : "strike";

class TableReader {
 public:
  explicit TableReader(const FractureTable& table) : table_(table) {}

  std::vector<FractureGeometry> read() {
    csv_ = split_csv(content());
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
    throw refused(
        "lacks columns",
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

/// The values of the columns that all fractures have, named as those of the first one.
std::vector<std::string> common_columns(const std::vector<FractureGeometry>& fractures) {
  std::vector<std::string> common;
  for (const ColumnValue& value : fractures.front().values) {
    const auto has_it = [&](const FractureGeometry& fracture) {
      return std::ranges::any_of(fracture.values, [&](const ColumnValue& other) {
        return other.column == value.column && other.unit == value.unit;
      });
    };
    if (std::ranges::all_of(fractures, has_it)) common.push_back(value.column);
  }
  return common;
}

void require_writable_name(const FractureGeometry& fracture) {
  if (fracture.name.find_first_of(",\"\n") == std::string::npos && fracture.name.front() != '#') return;
  throw InputError(fracture.origin, "the name of fracture '" + fracture.name + "' has no place in a table",
                   "it has a comma, a quotation mark, or begins with '#'", "rename it");
}

}  // namespace

std::string fracture_table(const std::vector<FractureGeometry>& fractures) {
  if (fractures.empty()) throw InputError("there are no fractures (the scene has none, or a mesh file holds them)");
  const bool are_straight =
      dimension == 2 && std::ranges::all_of(fractures, [](const auto& f) { return f.points.size() == 2; });
  const bool have_sizes = std::ranges::all_of(fractures, [](const auto& f) { return f.size.has_value(); });
  const std::vector<std::string> columns = common_columns(fractures);
  std::string text = are_straight     ? "name,x1[m],y1[m],x2[m],y2[m]"
                     : dimension == 2 ? "name,x[m],y[m]"
                                      : "name,x[m],y[m],z[m]";
  if (have_sizes) text += ",size[m]";
  for (const ColumnValue& value : fractures.front().values)
    if (std::ranges::count(columns, value.column))
      text += fmt::format(",{}{}", value.column, value.unit.empty() ? "" : "[" + value.unit + "]");
  text += "\n";
  for (const FractureGeometry& fracture : fractures) {
    require_writable_name(fracture);
    if (fracture.ellipse)
      throw InputError(fracture.origin, "fracture '" + fracture.name + "' is an ellipse",
                       "a table of points holds polygons", "leave it out");
    std::string further;
    if (have_sizes) further += fmt::format(",{}", *fracture.size);
    for (const std::string& column : columns)
      further += fmt::format(",{}", std::ranges::find(fracture.values, column, &ColumnValue::column)->value);
    const std::vector<Point>& points = fracture.points;
    if (are_straight)
      text += fmt::format("{},{},{},{},{}{}\n", fracture.name, points[0].x(), points[0].y(), points[1].x(),
                          points[1].y(), further);
    else
      for (const Point& point : points) text += fmt::format("{},{}{}\n", fracture.name, fmt::join(point, ","), further);
  }
  return text;
}

std::vector<FractureGeometry> read_fracture_table(const FractureTable& table) { return TableReader(table).read(); }

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
