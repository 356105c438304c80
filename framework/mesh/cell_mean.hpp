// Means over cells, for data that are densities.
#pragma once

#include <cmath>

#include "framework/mesh/mesh.hpp"
#include "framework/mesh/tetrahedra.hpp"

namespace sprekk {

/// The mean over a cell of a function of the position (m): exact for polynomials of second order (the mean over the
/// middles of the edges of each triangle of the cell; in space that over four points in each tetrahedron, Hammer and
/// Stroud 1956). With the value at the centre, which is exact for linear functions only, the error of a pressure with a
/// varying source would be twice as large.
template <typename Function>
auto cell_mean(const Mesh& mesh, int cell, const Function& value) {
  using Value = decltype(value(mesh.cell_center[cell]));
  Value sum = 0 * value(mesh.cell_center[cell]);
  if constexpr (dimension == 2) {
    const auto& corners = mesh.cell_nodes[cell];
    const Point& a = mesh.nodes[corners[0]];
    for (int k = 1; k + 1 < corners.size(); ++k) {
      const Point &b = mesh.nodes[corners[k]], &c = mesh.nodes[corners[k + 1]];
      const double area = ((b - a)[0] * (c - a)[1] - (b - a)[1] * (c - a)[0]) / 2;
      sum += area / 3 * (value((a + b) / 2) + value((b + c) / 2) + value((c + a) / 2));
    }
  } else {
    const double towards_corner = 1 / std::sqrt(5);  // of the way from the centre
    for (const auto& [corners, volume] : tetrahedra_of(mesh, cell)) {
      const Point center = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
      for (const Point& corner : corners) sum += volume / 4 * value(Point(center + towards_corner * (corner - center)));
    }
  }
  return Value(sum / mesh.cell_measure[cell]);
}

}  // namespace sprekk
