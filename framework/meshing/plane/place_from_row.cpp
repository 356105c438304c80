#include "framework/meshing/place_from_row.hpp"

namespace sprekk {

void place_from_row(const std::function<double(const std::string& column, const std::string& unit)>& value,
                    const std::function<bool(const std::string& column)>&, FractureGeometry& fracture) {
  const double x1 = value("x1", "m"), y1 = value("y1", "m"), x2 = value("x2", "m"), y2 = value("y2", "m");
  fracture.points = {Point(x1, y1), Point(x2, y2)};
}

}  // namespace sprekk
