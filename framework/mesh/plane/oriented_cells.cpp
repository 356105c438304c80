#include "framework/mesh/oriented_cells.hpp"

#include <algorithm>
#include <string>

#include "framework/config/input_error.hpp"
#include "framework/mesh/plane/cell_shape.hpp"
#include "framework/mesh/plane/planar.hpp"

namespace sprekk {
namespace {

/// Twice the area over the square of the longest edge, about the smallest angle in rad, below which geometry is lost
/// to rounding.
constexpr double smallest_flatness = 1e-10;

void require_triangle(const std::vector<Point>& nodes, const Ring& cell) {
  const Point &p = nodes[cell[0]], &q = nodes[cell[1]], &r = nodes[cell[2]];
  const double longest = std::max({(q - p).squaredNorm(), (r - q).squaredNorm(), (p - r).squaredNorm()});
  // The comparison is negated so that NaN is refused, too.
  if (!(std::abs(2 * signed_area(p, q, r)) > smallest_flatness * longest)) {
    throw InputError("the triangle at " + to_text((p + q + r) / 3) + " is degenerate (it has no area)");
  }
}

void require_convex(const std::vector<Point>& nodes, const Ring& cell) {
  double longest = 0;
  Point mean = Point::Zero();
  for (int k = 0; k < cell.size(); ++k) {
    longest = std::max(longest, (nodes[cell.after(k)] - nodes[cell[k]]).squaredNorm());
    mean += nodes[cell[k]] / 4;
  }
  Ring turned = cell;
  turned.turn();
  const double smallest = std::max(smallest_corner_area(nodes, cell), smallest_corner_area(nodes, turned));
  if (!mean.allFinite() || !(2 * smallest > smallest_flatness * longest)) {
    throw InputError("the quadrilateral at " + to_text(mean) +
                     " is not convex (a corner of it has no angle below 180 degrees) cut it into triangles");
  }
}

}  // namespace

void require_sound_cell(const std::vector<Point>& nodes, const Ring& cell) {
  cell.size() == 3 ? require_triangle(nodes, cell) : require_convex(nodes, cell);
}

std::vector<CellNodes> oriented_cells(const RawMesh& raw) {
  std::vector<Ring> cells = raw.cells;
  const int count = static_cast<int>(raw.nodes.size());
  for (Ring& cell : cells) {
    if (*std::min_element(cell.begin(), cell.end()) < 0 || *std::max_element(cell.begin(), cell.end()) >= count) {
      throw InputError("a cell names a node that does not exist (there are " + std::to_string(count) + " nodes)");
    }
    require_sound_cell(raw.nodes, cell);
    if (signed_area(raw.nodes, cell) < 0) cell.turn();
  }
  return cells;
}

}  // namespace sprekk
