#include "framework/meshing/fracture_geojson.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include "framework/config/csv_rows.hpp"
#include "framework/config/number.hpp"
#include "framework/config/yaml/parse_yaml.hpp"

namespace sprekk {
namespace {

constexpr const char* traces = dimension == 2 ? "LineString or MultiLineString" : "Polygon";

const Node& member(const Node& object, const std::string& key) {
  if (object.is_map())
    if (const Node* const value = object.find(key)) return *value;
  throw InputError(object.origin, fmt::format("the GeoJSON object has no '{}'", key),
                   "fractures are a FeatureCollection of features with 'type', 'geometry' and 'properties'");
}

std::optional<double> number_of(const Node& node) {
  if (!node.is_scalar()) return std::nullopt;
  const auto value = leading_number(node.scalar);
  if (!value || value->length != node.scalar.size() || !value->is_finite) return std::nullopt;
  return value->value;
}

Point point_of(const Node& position) {
  if (!position.is_list() || position.items.size() < dimension)
    throw InputError(position.origin, "a position has fewer than " + std::to_string(dimension) + " coordinates",
                     dimension == 2 ? "it is [x, y]" : "fractures in space have [x, y, z]");
  Point point;
  for (int axis = 0; axis < dimension; ++axis) {
    const std::optional<double> value = number_of(position.items[axis]);
    if (!value)
      throw InputError(position.items[axis].origin,
                       fmt::format("'{}' is not a finite number", position.items[axis].text()), "coordinates are in m");
    point[axis] = *value;
  }
  return point;
}

/// Points that follow themselves, as digitized lines have them, are one.
std::vector<Point> points_of(const Node& positions) {
  if (!positions.is_list()) throw InputError(positions.origin, "the coordinates are no list of positions");
  std::vector<Point> points;
  for (const Node& position : positions.items)
    if (const Point point = point_of(position); points.empty() || point != points.back()) points.push_back(point);
  return points;
}

/// The lines, or polygons, of a geometry. The first point of a ring, which ends it too, is left out.
std::vector<std::vector<Point>> shapes_of(const Node& geometry) {
  const std::string& type = member(geometry, "type").scalar;
  static const Node nothing;
  const Node* const given = geometry.find("coordinates");  // a GeometryCollection has none
  const Node& coordinates = given ? *given : nothing;
  if (dimension == 2 && type == "LineString") return {points_of(coordinates)};
  std::vector<std::vector<Point>> shapes;
  if (dimension == 2 && type == "MultiLineString") {
    for (const Node& line : coordinates.items) shapes.push_back(points_of(line));
    return shapes;
  }
  if (dimension == 3 && type == "Polygon") {
    if (coordinates.items.size() != 1)
      throw InputError(coordinates.origin, fmt::format("the polygon has {} rings", coordinates.items.size()),
                       "a fracture has one, and no holes");
    shapes.push_back(points_of(coordinates.items.front()));
    if (shapes.front().size() > 1 && shapes.front().front() == shapes.front().back()) shapes.front().pop_back();
    return shapes;
  }
  throw InputError(geometry.origin, fmt::format("a '{}' is no fracture", type),
                   fmt::format("fractures are of the type {}", traces), "leave the feature out, or convert it");
}

/// Refuses degrees: lengths of the scene are in m.
void require_metres(const Node& collection) {
  const Node* const system = collection.find("crs");
  if (!system) return;
  const std::string text = system->text();
  for (const char* const degrees : {"CRS84", "EPSG::4326", "EPSG:4326"})
    if (text.find(degrees) != std::string::npos)
      throw InputError(system->origin, "the coordinates are degrees", fmt::format("the file's system is {}", degrees),
                       "project them to metres (ogr2ogr -t_srs EPSG:…)");
}

class Reader {
 public:
  Reader(std::string file, std::string set) : file_(std::move(file)), set_(std::move(set)) {}

  std::vector<FractureGeometry> read(const std::string& content, const Origin& where) {
    const Node root = parse_yaml(content, file_);  // JSON is a part of YAML
    if (!root.is_map())
      throw InputError(where, fmt::format("the file '{}' is no GeoJSON", file_), "it is an object in { }");
    const std::string& type = member(root, "type").scalar;
    require_metres(root);
    if (type == "Feature") {
      add(root);
    } else {
      for (const Node& feature : member(root, "features").items) add(feature);
    }
    if (fractures_.empty())
      throw InputError(where, fmt::format("the file '{}' holds no fracture", file_),
                       fmt::format("fractures are features whose geometry is a {}", traces));
    return std::move(fractures_);
  }

 private:
  void add(const Node& feature) {
    const Node& geometry = member(feature, "geometry");
    if (geometry.is_null()) return;
    FractureGeometry fracture = with_properties(feature);
    std::vector<std::vector<Point>> shapes = shapes_of(geometry);
    const std::string name = fracture.name;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      if (shapes.size() > 1) fracture.name = fmt::format("{}_{}", name, i + 1);
      fracture.points = std::move(shapes[i]);
      fractures_.push_back(fracture);
    }
  }

  FractureGeometry with_properties(const Node& feature) {
    FractureGeometry fracture{fmt::format("{}_{}", set_, ++features_), {}, std::nullopt, feature.origin};
    if (const Node* const id = feature.find("id"); id && id->is_scalar()) fracture.name = id->scalar;
    const Node* const properties = feature.find("properties");
    if (!properties || !properties->is_map()) return fracture;
    for (const Node::Entry& property : properties->entries) {
      if (property.key == "name" && property.value.is_scalar()) fracture.name = property.value.scalar;
      const std::optional<double> value = number_of(property.value);
      if (!value || property.key == "name") continue;
      const CsvHeading heading = heading_of(property.key);
      if (heading.name == "size")
        fracture.size = *value * heading_scale(heading, "m", file_);
      else
        fracture.values.push_back({heading.name, heading.unit, *value, property.value.origin});
    }
    if (fracture.size && !(*fracture.size > 0))
      throw InputError(feature.origin, fmt::format("the size {} is not positive", *fracture.size),
                       "it is the length of cells");
    return fracture;
  }

  std::string file_, set_;
  int features_ = 0;
  std::vector<FractureGeometry> fractures_;
};

}  // namespace

bool is_geojson(const std::string& file) {
  const std::string ending = std::filesystem::path(file).extension().string();
  return ending == ".geojson" || ending == ".json";
}

std::vector<FractureGeometry> read_fracture_geojson(const std::string& content, const std::string& file,
                                                    const std::string& set, const Origin& where) {
  return Reader(file, set).read(content, where);
}

}  // namespace sprekk
