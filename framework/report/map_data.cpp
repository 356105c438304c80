#include "framework/report/map_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "framework/picture/colours.hpp"
#include "framework/picture/display_unit.hpp"
#include "framework/report/base64.hpp"
#include "framework/report/fracture_names.hpp"
#include "framework/report/fracture_path.hpp"
#include "framework/types.hpp"

namespace sprekk {
namespace {

using Json = nlohmann::ordered_json;

constexpr int colour_count = 256;

/// Files have a third component of vectors for ParaView only.
bool is_vector(const Grid::Values& sample) {
  return !sample.component_names.empty() && sample.component_names.front() == "x";
}

void add_fields(const Grid::Values& sample, std::vector<MapField>& fields) {
  const ColumnName name = column_name(sample.name);
  if (sample.components == 1) {
    fields.push_back({name.quantity, name.unit, sample.name, 0});
  } else if (is_vector(sample)) {
    fields.push_back({name.quantity + ", length", name.unit, sample.name, MapField::length_of_vector});
    fields.push_back({name.quantity + ", x", name.unit, sample.name, 0});
    fields.push_back({name.quantity + ", y", name.unit, sample.name, 1});
    if (dimension == 3) fields.push_back({name.quantity + ", z", name.unit, sample.name, 2});
  } else {
    for (int c = 0; c < sample.components; ++c) {
      const auto& names = sample.component_names;
      const std::string part = names.empty() ? std::to_string(c + 1) : names[static_cast<std::size_t>(c)];
      fields.push_back({name.quantity + ", " + part, name.unit, sample.name, c});
    }
  }
}

std::vector<double> values_of(const Grid& grid, const MapField& field) {
  std::vector<double> result;
  const Grid::Values* const all = grid.find(field.array);
  if (all == nullptr) return result;
  for (std::size_t i = 0; i < all->values.size(); i += static_cast<std::size_t>(all->components))
    result.push_back(field.component == MapField::length_of_vector
                         ? std::hypot(all->values[i], all->values[i + 1], all->components > 2 ? all->values[i + 2] : 0)
                         : all->values[i + static_cast<std::size_t>(field.component)]);
  return result;
}

struct ColourRange {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  void include(const std::vector<double>& values) {
    for (const double value : values)
      if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  }
};

std::string packed(const std::vector<double>& values, const ColourRange& range) {
  std::vector<std::uint16_t> fractions;
  const double size = range.high - range.low;
  for (const double value : values) {
    const double fraction = size > 0 && std::isfinite(value) ? (value - range.low) / size : 0;
    fractions.push_back(static_cast<std::uint16_t>(std::lround(65535 * fraction)));
  }
  return base64_of(fractions);
}

Json mesh_json(const Grid& grid) {
  std::vector<float> points;
  for (const auto& point : grid.points) points.insert(points.end(), {float(point[0]), float(point[1])});
  return {{"points", base64_of(points)},
          {"cells", base64_of(std::vector<std::uint32_t>(grid.cells.begin(), grid.cells.end()))}};
}

/// Adds every line of the grid as a list x, y, x, y, …
void add_lines(const Grid& fractures, Json& lines) {
  for (int i = 0; dimension == 3 && i < fractures.cell_count(); ++i) {
    const auto &from = fractures.points[fractures.cells[2 * i]], &to = fractures.points[fractures.cells[2 * i + 1]];
    lines.push_back({from[0], from[1], to[0], to[1]});
  }
  if (dimension == 3) return;
  std::vector<int> all(static_cast<std::size_t>(fractures.cell_count()));
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
  std::optional<PathOrigin> origin;
  for (const FracturePath& path : fracture_paths(fractures, all, origin)) {
    Json line = Json::array();
    for (const auto& point : path.points) line.insert(line.end(), {point[0], point[1]});
    lines.push_back(line);
  }
}

/// All fractures, and the paths of growth that the mesh does not have yet.
Json lines_json(const RunResults::Written& written) {
  Json lines = Json::array();
  add_lines(written.fractures, lines);
  add_lines(written.paths, lines);
  return lines;
}

/// The ends of the cells of fractures, and the number of the fracture of each.
void add_segments(const Grid& fractures, Json& time) {
  std::vector<float> ends;
  for (const int point : fractures.cells) {
    const auto& position = fractures.points[static_cast<std::size_t>(point)];
    ends.insert(ends.end(), {float(position[0]), float(position[1])});
  }
  std::vector<std::uint16_t> numbers;
  if (const Grid::Values* const number = fractures.find("fracture"))
    for (const double value : number->values) numbers.push_back(static_cast<std::uint16_t>(value));
  time["segments"] = base64_of(ends);
  time["fracture"] = base64_of(numbers);
}

Json names_json(const RunResults& results) {
  int count = 0;
  for (const RunResults::Written& written : results.written)
    if (const Grid::Values* const number = written.fractures.find("fracture"))
      for (const double value : number->values) count = std::max(count, static_cast<int>(value) + 1);
  if (count == 0) return Json::array();
  return fracture_names(results.record, static_cast<std::size_t>(count));
}

std::size_t bytes_of(const Grid& grid, std::size_t field_count) {
  const std::size_t mesh = 8 * grid.points.size() + 4 * grid.cells.size();
  return (mesh + 2 * field_count * std::max<std::size_t>(grid.points.size(), grid.cells.size() / 3)) * 4 / 3;
}

/// The indices of times that are shown: evenly chosen, the last among them.
std::vector<const RunResults::Written*> chosen(const RunResults& results, std::size_t field_count, std::size_t most) {
  std::size_t largest = 1;
  for (const auto& written : results.written) largest = std::max(largest, bytes_of(written.matrix, field_count));
  const std::size_t count = std::clamp<std::size_t>(most / largest, 1, results.written.size());
  std::vector<const RunResults::Written*> result;
  for (std::size_t i = 1; i <= count; ++i) result.push_back(&results.written[i * results.written.size() / count - 1]);
  if (count == results.written.size() || count < 2) return result;
  result.front() = &results.written.front();
  return result;
}

}  // namespace

std::vector<MapField> map_fields(const RunResults& results) {
  std::vector<MapField> fields;
  if (results.written.empty()) return fields;
  const std::vector<Grid::Values>& arrays = results.written.back().matrix.arrays;
  const auto add_all = [&](const auto& is_wanted) {
    for (const Grid::Values& values : arrays)
      if (is_wanted(values)) add_fields(values, fields);
  };
  add_all([](const Grid::Values& values) { return values.components == 1 && values.name != "region"; });
  add_all([](const Grid::Values& values) { return values.components != 1; });
  add_all([](const Grid::Values& values) { return values.name == "region"; });
  return fields;
}

std::vector<MapField> fracture_map_fields(const RunResults& results) {
  std::vector<MapField> fields;
  if (results.written.empty()) return fields;
  for (const Grid::Values& values : results.written.back().fractures.arrays) {
    if (values.place != Grid::Place::cell || values.components != 1 || values.name == "fracture") continue;
    const ColumnName name = column_name(values.name);
    fields.push_back({name.quantity, name.unit, values.name, 0});
  }
  return fields;
}

namespace {

/// The range of a field over the given grids, and its entry in the JSON.
ColourRange add_field(const MapField& field, const std::vector<const Grid*>& grids, Json& entries) {
  ColourRange range;
  for (const Grid* grid : grids) range.include(values_of(*grid, field));
  if (range.low > range.high) range = {0, 0};
  const DisplayUnit unit = display_unit(field.unit, std::max(std::abs(range.low), std::abs(range.high)));
  const Grid::Values* const array = grids.back()->find(field.array);
  entries.push_back({{"label", field.label},
                     {"unit", unit.text},
                     {"low", range.low / unit.scale},
                     {"high", range.high / unit.scale},
                     {"onPoints", array != nullptr && array->place == Grid::Place::point}});
  return range;
}

}  // namespace

std::string map_json(const RunResults& results, std::size_t most_bytes) {
  const std::vector<MapField> fields = map_fields(results), line_fields = fracture_map_fields(results);
  Json data = {{"inSpace", dimension == 3},  // points are projected
               {"edges", Json::array()},      {"colours", Json::array()},     {"fields", Json::array()},
               {"lineFields", Json::array()}, {"names", names_json(results)}, {"meshes", Json::array()},
               {"times", Json::array()}};
  for (const DrawnEdge& edge : results.edges)
    data["edges"].push_back(
        {{"name", edge.coordinate}, {"from", edge.from}, {"to", edge.to}, {"low", edge.low}, {"high", edge.high}});
  for (int i = 0; i < colour_count; ++i) data["colours"].push_back(viridis(i / (colour_count - 1.0)));
  const auto times = chosen(results, fields.size(), most_bytes);
  std::vector<const Grid*> grids, lines;
  for (const RunResults::Written* written : times) {
    grids.push_back(&written->matrix);
    lines.push_back(&written->fractures);
  }
  std::vector<ColourRange> ranges, line_ranges;
  for (const MapField& field : fields) ranges.push_back(add_field(field, grids, data["fields"]));
  for (const MapField& field : line_fields) line_ranges.push_back(add_field(field, lines, data["lineFields"]));
  const Grid* last_mesh = nullptr;
  const DisplayUnit time_unit = display_unit("s", times.empty() ? 0 : times.back()->time);
  for (const RunResults::Written* written : times) {
    const Grid& grid = written->matrix;
    if (!last_mesh || last_mesh->points != grid.points || last_mesh->cells != grid.cells) {
      data["meshes"].push_back(mesh_json(grid));
      last_mesh = &grid;
    }
    Json values = Json::array();
    for (std::size_t i = 0; i < fields.size(); ++i) values.push_back(packed(values_of(grid, fields[i]), ranges[i]));
    data["times"].push_back({{"text", display_text(written->time, time_unit)},
                             {"mesh", data["meshes"].size() - 1},
                             {"lines", lines_json(*written)},
                             {"values", values}});
    add_segments(written->fractures, data["times"].back());
    Json line_values = Json::array();
    for (std::size_t i = 0; i < line_fields.size(); ++i)
      line_values.push_back(packed(values_of(written->fractures, line_fields[i]), line_ranges[i]));
    data["times"].back()["lineValues"] = line_values;
  }
  std::string text = data.dump();
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos; ++at) text.replace(at, 1, "\\u003c");
  return text;  // so that no name in it can end the script that holds it
}

}  // namespace sprekk
