#include "framework/mesh/oriented_cells.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <string>

#include "framework/config/input_error.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

CellNodes mirrored(const CellNodes& cell) {
  CellNodes nodes = cell;
  if (cell.size() == 4)
    std::swap(nodes[0], nodes[1]);
  else
    std::rotate(nodes.begin(), nodes.begin() + nodes.size() / 2, nodes.end());  // top and bottom
  return nodes;
}

/// The smallest of the volumes that the three edges at each corner span, times six: positive where the cell is convex
/// there. In all shapes three edges meet at each corner.
double smallest_corner(const std::vector<Point>& nodes, const CellNodes& cell) {
  const auto& faces = shape_with(cell.size())->faces;
  double smallest = std::numeric_limits<double>::infinity();
  for (const FaceNodes& face : faces)
    for (int k = 0; k < face.size(); ++k) {
      const int corner = face[k], next = face.after(k), before = face.before(k);
      for (const FaceNodes& other : faces)
        for (int j = 0; j < other.size(); ++j) {
          if (other[j] != corner || other.after(j) == next || other.after(j) == before) continue;
          const Point& x = nodes[cell[corner]];
          const Point outward = (nodes[cell[next]] - x).cross(nodes[cell[before]] - x);
          smallest = std::min(smallest, outward.dot(x - nodes[cell[other.after(j)]]));
        }
    }
  return smallest;
}

}  // namespace

void require_sound_cell(const std::vector<Point>& nodes, const CellNodes& cell) {
  Point mean = Point::Zero();
  double longest = 0;
  for (const int node : cell) {
    mean += nodes[node] / cell.size();
    for (const int other : cell) longest = std::max(longest, (nodes[node] - nodes[other]).norm());
  }
  const double smallest = std::max(smallest_corner(nodes, cell), smallest_corner(nodes, mirrored(cell)));
  // The comparison is negated so that NaN is refused, too.
  if (mean.allFinite() && smallest > rounding::same * longest * longest * longest) return;
  const std::string name = shape_with(cell.size())->name;
  throw InputError("the " + name + " at " + to_text(mean) +
                   (cell.size() == 4
                        ? " is degenerate (it has no volume)"
                        : " is not convex (the edges at a corner of it span no volume) cut it into tetrahedra"));
}

std::vector<CellNodes> oriented_cells(const RawMesh& raw) {
  std::vector<CellNodes> cells = raw.cells;
  const int count = static_cast<int>(raw.nodes.size());
  for (CellNodes& cell : cells) {
    if (std::ranges::any_of(cell, [&](int node) { return node < 0 || node >= count; }))
      throw InputError("a cell names a node that does not exist (there are " + std::to_string(count) + " nodes)");
    if (!shape_with(cell.size())) {
      throw InputError("a cell at " + to_text(raw.nodes[cell[0]]) + " has " + std::to_string(cell.size()) +
                       " corners (tetrahedra, wedges and hexahedra have 4, 6 and 8) divide " +
                       (cell.size() == 5 ? "pyramids" : "it") + " into tetrahedra");
    }
    require_sound_cell(raw.nodes, cell);
    if (cell_geometry(raw.nodes, cell).measure < 0) cell = mirrored(cell);
  }
  return cells;
}

}  // namespace sprekk
