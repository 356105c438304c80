#include "framework/meshing/spec/places.hpp"

#include <cmath>

#include "framework/config/usual_range.hpp"
#include "framework/mesh/medium.hpp"

namespace sprekk {

const char* const fracture_doc =
    "A polyline, given by its points or as a straight line by center, length and angle; or a set of fractures, "
    "from a table or drawn at random.";
const char* const table_columns =
    "a row for each with the columns x1, y1, x2, y2, or for each point of a polyline with name, x, y";

void add_place(Spec& spec, const std::shared_ptr<FracturePlace>& place) {
  spec.points("points", place->points,
              {.unit = "m", .doc = "The points of the polyline; the plus side is to its left."});
  spec.point("center", place->center, {.unit = "m", .doc = "The middle of a straight fracture."});
  spec.quantity("length", place->length,
                {.unit = "m", .range = positive(), .doc = "The length of a straight fracture."});
  spec.quantity(
      "angle", place->angle,
      {.unit = "rad", .doc = "The direction of a straight fracture, counter-clockwise from the x axis; by default 0."});
  usually(spec, "angle", usual_angle());
}

void take_place(const FracturePlace& place, const Node& whole, FractureGeometry& fracture) {
  fracture.points = place.points;
  const bool has_points = !place.points.empty(), has_center = place.center.has_value();
  const bool has_line = has_center || place.length || place.angle;
  if (has_points && has_line) {
    throw InputError(whole.origin, "fracture '" + fracture.name + "' is given twice",
                     "it has points and also center, length or angle", "keep one of the two");
  }
  if (!has_points && !(has_center && place.length)) {
    throw InputError(whole.origin, "fracture '" + fracture.name + "' is not given completely",
                     "it needs points, or center and length",
                     "write points: [[x, y], [x, y]] or center: [x, y], length: …, angle: …");
  }
  if (has_center) {
    const double angle = place.angle.value_or(0);
    const Point half = 0.5 * *place.length * Point(std::cos(angle), std::sin(angle));
    fracture.points = {*place.center - half, *place.center + half};
  }
}

Spec region_spec(const std::string& name, const Origin& origin, std::function<void(RegionGeometry)> keep) {
  const auto polygon = std::make_shared<std::vector<Point>>();
  Spec spec("region", "A part of the " + medium_name() + " that may have properties of its own.");
  spec.points("polygon", *polygon,
              {.unit = "m", .doc = "The corners in order, not repeating the first.", .required = true});
  spec.check([polygon, name, origin, keep = std::move(keep)](const Node&) { keep({name, *polygon, origin}); });
  return spec;
}

}  // namespace sprekk
