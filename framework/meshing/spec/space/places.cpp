#include "framework/meshing/spec/places.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>
#include <regex>

#include "framework/config/data_reader.hpp"
#include "framework/config/units.hpp"
#include "framework/config/unknown_key.hpp"
#include "framework/config/usual_range.hpp"
#include "framework/mesh/medium.hpp"
#include "framework/meshing/space/strike_and_dip.hpp"
#include "framework/round_off.hpp"

namespace sprekk {

const char* const fracture_doc =
    "A flat polygon, given by its points or as a rectangle by center, strike, dip, length and height; a disc or an "
    "ellipse, by center, strike, dip and radius; or a set of fractures, from a table or drawn at random.";
const char* const table_columns =
    "a row for each with the columns x, y, z, strike, dip and length, height or radius, or for each point of a polygon "
    "with name, x, y, z";

namespace {

std::vector<double> read_radius(const Node& node) {
  std::vector<double> radius;
  if (!node.is_list()) return {read_number(node, "m", positive(), "radius")};
  for (const Node& item : node.items) radius.push_back(read_number(item, "m", positive(), "radius"));
  if (radius.size() == 2) return radius;
  throw InputError(node.origin, "'radius' has " + std::to_string(radius.size()) + " values",
                   "a disc has one, an ellipse one along strike and one along dip", "write radius: [20 m, 10 m]");
}

}  // namespace

void add_place(Spec& spec, const std::shared_ptr<FracturePlace>& place) {
  spec.points("points", place->points,
              {.unit = "m",
               .doc = "The corners of a flat polygon in their order; the plus side is that from which they turn "
                      "clockwise."});
  spec.point("center", place->center, {.unit = "m", .doc = "The middle of a rectangle, disc or ellipse."});
  spec.quantity("strike", place->strike,
                {.unit = "rad",
                 .doc = "The direction of the horizontal line in a rectangle, disc or ellipse, clockwise from north "
                        "(y); it dips to the right of it. By default 0."});
  usually(spec, "strike", usual_angle());
  spec.quantity(
      "dip", place->dip,
      {.unit = "rad",
       .range = between(0, std::numbers::pi / 2),
       .doc = "How steeply it dips: 0 is horizontal, 90 degrees upright. By default 90 degrees. The plus side "
              "is below it, or to the left of the strike."});
  spec.quantity("length", place->length,
                {.unit = "m", .range = positive(), .doc = "The length of a rectangle along its strike."});
  spec.quantity("height", place->height,
                {.unit = "m", .range = positive(), .doc = "The length of a rectangle along its dip."});
  spec.custom("radius", [place](const Node& node) { place->radius = read_radius(node); },
              {.unit = "m",
               .doc = "A length: the radius of a disc. Two, as [20 m, 10 m]: half axes of an ellipse, along strike and "
                      "along dip."});
  write_instead(spec.name(), "angle", "write strike: … and dip: … for the direction of a fracture in space");
}

void take_place(const FracturePlace& place, const Node& whole, FractureGeometry& fracture) {
  const std::string what = "fracture '" + fracture.name + "'";
  const bool has_center = place.center.has_value(), is_round = !place.radius.empty();
  const bool has_plane = has_center || is_round || place.strike || place.dip || place.length || place.height;
  fracture.points = place.points;
  if (!place.points.empty()) {
    if (has_plane)
      throw InputError(whole.origin, what + " is given twice", "it has points and also center, strike, dip or lengths",
                       "keep one of the two");
    return;
  }
  if (is_round && (place.length || place.height))
    throw InputError(whole.origin, what + " is given twice", "it has a radius and also length or height",
                     "keep one of the two");
  if (!has_center || !(is_round || (place.length && place.height)))
    throw InputError(whole.origin, what + " is not given completely",
                     "it needs points, or center with a radius, or center with length and height",
                     "write points: [[x, y, z], …], or center: [x, y, z], strike: …, dip: …, radius: …");
  const StrikeAndDip plane{place.strike.value_or(0), place.dip.value_or(std::numbers::pi / 2)};
  if (is_round)
    fracture.ellipse = ellipse(*place.center, plane, place.radius.front(), place.radius.back());
  else
    fracture.points = rectangle(*place.center, plane, *place.length, *place.height);
}

namespace {

/// A height z(x, y), and the plane that it is everywhere, if it is one.
struct Surface {
  Data height;
  std::optional<HalfSpace> plane;
};

struct RegionKeys {
  std::array<std::vector<double>, dimension> box;
  bool has_box = false;
  std::optional<Point> point, normal;
  std::vector<Surface> between;
};

Spec region_box_spec(const std::shared_ptr<RegionKeys>& input) {
  Spec spec("region.box", "What lies between two values along one or more axes.");
  for (int axis = 0; axis < dimension; ++axis) {
    const std::string key(1, "xyz"[axis]);
    spec.quantities(key, input->box[axis],
                    {.unit = "m", .doc = "Where it begins and ends along " + key + "; by default with the box."});
  }
  spec.check([input](const Node& whole) {
    for (int axis = 0; axis < dimension; ++axis) {
      const std::vector<double>& ends = input->box[axis];
      const std::string key(1, "xyz"[axis]);
      if (!ends.empty() && (ends.size() != 2 || !(ends[0] < ends[1])))
        throw InputError(whole.find(key)->origin, "the region needs two growing values along " + key,
                         std::to_string(ends.size()) + " are given, or they do not grow",
                         "write " + key + ": [0 m, 1 m]");
    }
  });
  return spec;
}

double height_at(const Data& surface, double x, double y) { return surface.at({Point(x, y, 0), 0, 0}); }

/// Whether a name stands alone in an expression.
bool names(const std::string& expression, const std::string& name) {
  return std::regex_search(expression, std::regex("(^|[^A-Za-z0-9_.])" + name + "($|[^A-Za-z0-9_])"));
}

/// Whether x and y stand in sums, products and quotients alone: what is a plane at some places then is one everywhere.
bool is_rational(const std::string& expression) {
  return !std::regex_search(expression, std::regex("[A-Za-z_][A-Za-z0-9_]* *\\(|[\\^<>=!&|?]"));
}

/// The plane that a rational height is, if it is one.
std::optional<HalfSpace> plane_of(const Data& surface) {
  const double z = height_at(surface, 0, 0);
  const double slope_x = height_at(surface, 1, 0) - z, slope_y = height_at(surface, 0, 1) - z;
  // Places of very different sizes.
  constexpr std::array places_x = {-1.17e5, -713.0, 0.37, 53.0, 2.31e4};
  constexpr std::array places_y = {-3.3e4, -91.0, 0.83, 417.0, 1.9e5};
  for (const double x : places_x)
    for (const double y : places_y) {
      const double flat = z + slope_x * x + slope_y * y;
      if (std::abs(height_at(surface, x, y) - flat) >
          rounding::same * (std::abs(z) + std::abs(x) + std::abs(y)) * std::max(1.0, std::hypot(slope_x, slope_y)))
        return std::nullopt;
    }
  return HalfSpace{Point(0, 0, z), Point(-slope_x, -slope_y, 1)};
}

std::vector<Surface> read_surfaces(const Node& node) {
  if (!node.is_list() || node.items.size() != 2)
    throw InputError(node.origin, "'between' is no list of two heights", "a layer has a bottom and a top",
                     "write between: [-20 m, (5 + 0.1*x) m]");
  std::vector<Surface> surfaces;
  for (const Node& item : node.items) {
    if (!item.is_scalar())
      throw InputError(item.origin, "a height in 'between' is no number and no expression of x and y",
                       "it is the height z of a surface", "write between: [-20 m, (5 + 0.1*x) m]");
    const Data height = parse_data(item.scalar, "m", item.origin, "between");
    if (height.depends_on_time() || names(item.scalar, "z"))
      throw InputError(item.origin,
                       std::string("a height in 'between' depends on ") + (height.depends_on_time() ? "time" : "z"),
                       height.depends_on_time() ? "regions stay where they are" : "it is the z of a surface",
                       "write an expression of x and y");
    const bool may_be_plane = height.is_constant() || is_rational(item.scalar);
    surfaces.push_back({height, may_be_plane ? plane_of(height) : std::nullopt});
  }
  const Data &bottom = surfaces[0].height, &top = surfaces[1].height;
  if (bottom.is_constant() && top.is_constant() && height_at(bottom, 0, 0) >= height_at(top, 0, 0))
    throw InputError(node.origin, "the bottom in 'between' is not below the top",
                     "the first height is that of the bottom", "exchange them");
  return surfaces;
}

}  // namespace

Spec region_spec(const std::string& name, const Origin& origin, std::function<void(RegionGeometry)> keep) {
  const auto input = std::make_shared<RegionKeys>();
  Spec spec("region", "A part of the " + medium_name() +
                          " that may have properties of its own: what its box, its "
                          "half-space and its layer, as far as they are given, have in common.");
  spec.section("box", region_box_spec(input), {.doc = "What lies in a box."}, &input->has_box);
  spec.point("point", input->point, {.unit = "m", .doc = "A point of a plane; the region lies on one side of it."});
  spec.point("normal", input->normal, {.unit = "", .doc = "The direction from the plane into the region."});
  spec.custom(
      "between", [input](const Node& node) { input->between = read_surfaces(node); },
      {.unit = "m",
       .doc = "The heights z of the bottom and the top of a layer: numbers, or expressions of x and y. The mesh "
              "conforms to those that are sums and products of x, y and numbers and make a plane; cells belong to the "
              "region "
              "in which their centre lies."});
  write_instead(spec.name(), "polygon", "write box: …, point: … and normal: …, or between: […] for a region in space");
  spec.check([input, name, origin, keep = std::move(keep)](const Node& whole) {
    RegionGeometry region{name, {}, origin};
    if (input->point.has_value() != input->normal.has_value())
      throw InputError(whole.origin, "region '" + name + "' is not given completely",
                       "a half-space has a point and a normal", "write point: [x, y, z] and normal: [0, 0, 1]");
    for (int axis = 0; axis < dimension; ++axis)
      if (const std::vector<double>& ends = input->box[axis]; !ends.empty()) {
        region.half_spaces.push_back({ends[0] * Point::Unit(axis), Point::Unit(axis)});
        region.half_spaces.push_back({ends[1] * Point::Unit(axis), -Point::Unit(axis)});
      }
    if (input->point) region.half_spaces.push_back({*input->point, *input->normal});
    for (std::size_t i = 0; i < input->between.size(); ++i) {
      const auto& [height, plane] = input->between[i];
      if (plane)
        region.half_spaces.push_back({plane->point, (i == 0 ? 1 : -1) * plane->normal});
      else
        (i == 0 ? region.bottom : region.top) = [height = height](double x, double y) {
          return height_at(height, x, y);
        };
    }
    if (region.half_spaces.empty() && !region.bottom && !region.top)
      throw InputError(whole.origin, "region '" + name + "' has no place", "it needs a box, a half-space or a layer",
                       "write box: {x: [0 m, 1 m]}, or point and normal, or between");
    keep(std::move(region));
  });
  return spec;
}

}  // namespace sprekk
