#include "framework/meshing/short_fractures.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sprekk {

std::string note_on_short_fractures(const Geometry& geometry, const MeshOptions& options) {
  if (options.kind == MeshOptions::Kind::structured) return "";
  const FractureGeometry* worst = nullptr;
  double least = 1, shortest = 0, cell = 0;
  int count = 0;
  for (const FractureGeometry& fracture : geometry.fractures) {
    double length = dimension == 2 ? 0 : extent_of(fracture);
    for (std::size_t i = 0; dimension == 2 && i + 1 < fracture.points.size(); ++i)
      length += (fracture.points[i + 1] - fracture.points[i]).norm();
    double size = size_at(fracture, geometry, options);
    size = std::min(size, options.tip_size.value_or(size));
    if (length >= size) continue;
    ++count;
    if (length / size >= least) continue;
    least = length / size;
    worst = &fracture;
    shortest = length;
    cell = size;
  }
  if (!worst) return "";
  return fmt::format(
      "{}: fracture '{}' is {:.3g} m long, shorter than the cell of {:.3g} m that it is asked for{} (it has one cell "
      "for each of its segments, and its values are as coarse) give it a size, or leave it out",
      worst->origin.text(), worst->name, shortest, cell,
      count > 1 ? fmt::format("; so are {} more fractures", count - 1) : "");
}

}  // namespace sprekk
