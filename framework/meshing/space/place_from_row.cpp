#include "framework/meshing/place_from_row.hpp"

#include <numbers>

#include "framework/meshing/space/strike_and_dip.hpp"

namespace sprekk {

void place_from_row(const std::function<double(const std::string& column, const std::string& unit)>& value,
                    const std::function<bool(const std::string& column)>& has, FractureGeometry& fracture) {
  const auto positive = [&](const std::string& column) {
    const double length = value(column, "m");
    if (length > 0) return length;
    throw InputError(fracture.origin, "the " + column + " of fracture '" + fracture.name + "' is not positive",
                     "it is a length", "give it another value");
  };
  const Point center(value("x", "m"), value("y", "m"), value("z", "m"));
  const StrikeAndDip plane{value("strike", "rad"), value("dip", "rad")};
  if (!(plane.dip >= 0 && plane.dip <= std::numbers::pi / 2))
    throw InputError(fracture.origin, "the dip of fracture '" + fracture.name + "' is not from 0 to 90 degrees",
                     "it counts from the horizontal, to the right of the strike",
                     "where it dips to the left, turn the strike by 180 degrees");
  if (has("radius")) {
    const double radius = positive("radius");
    fracture.ellipse = ellipse(center, plane, radius, radius);
  } else {
    const double length = positive("length"), height = positive("height");
    fracture.points = rectangle(center, plane, length, height);
  }
}

}  // namespace sprekk
