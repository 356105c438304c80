#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "framework/meshing/fracture_table.hpp"

namespace sprekk {
namespace {

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

}  // namespace sprekk
