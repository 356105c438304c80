// A row of a table as a fracture.
#pragma once

#include <functional>
#include <string>

#include "framework/meshing/geometry.hpp"

namespace sprekk {

/// Gives the fracture the place that a row says: in a plane from (x1, y1) to (x2, y2); in space around (x, y, z), with
/// strike and dip, a rectangle of length and height or a disc with a radius. `value(column, unit)`: the value of a
/// column in this SI unit; `has(column)`: whether there is such a column. Throws what these throw.
void place_from_row(const std::function<double(const std::string& column, const std::string& unit)>& value,
                    const std::function<bool(const std::string& column)>& has, FractureGeometry& fracture);

}  // namespace sprekk
