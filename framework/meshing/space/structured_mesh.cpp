#include "framework/meshing/structured_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "framework/mesh/face_table.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/mesh/oriented_cells.hpp"
#include "framework/meshing/regions.hpp"
#include "framework/meshing/space/flat_shape.hpp"
#include "framework/meshing/space/outer_sides.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

using CellShape = MeshOptions::Shape;

/// The grid's nodes, and which diagonals its cells have. A node is even along an axis when its number plus the parity
/// is. Diagonals lead from nodes that are even along both or all of their axes to those that are odd along them, so
/// that neighbours agree.
struct Grid {
  Box box;
  std::array<int, 3> cells;
  CellShape shape;
  std::array<int, 3> parity;

  int node(const std::array<int, 3>& at) const { return at[0] + (cells[0] + 1) * (at[1] + (cells[1] + 1) * at[2]); }
  Point position(const std::array<int, 3>& at) const {
    Point x;
    for (int axis = 0; axis < 3; ++axis)
      x[axis] = at[axis] == cells[axis] ? box.high[axis] : box.low[axis] + at[axis] * (box.size()[axis] / cells[axis]);
    return x;
  }
  /// The corner of a cell with these offsets (0 or 1) from its even corner.
  int corner(const std::array<int, 3>& cell, const std::array<int, 3>& offset) const {
    std::array<int, 3> at;
    for (int axis = 0; axis < 3; ++axis) {
      const bool is_even = (cell[axis] + parity[axis]) % 2 == 0;
      at[axis] = cell[axis] + (is_even ? offset[axis] : 1 - offset[axis]);
    }
    return node(at);
  }

  void add_cell(const std::array<int, 3>& cell, RawMesh& mesh) const {
    const auto at = [&](int x, int y, int z) { return corner(cell, {x, y, z}); };
    if (shape == CellShape::hexahedra) {
      mesh.cells.push_back(
          {at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0), at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)});
    } else if (shape == CellShape::wedges) {
      mesh.cells.push_back({at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 0, 1), at(1, 0, 1), at(1, 1, 1)});
      mesh.cells.push_back({at(0, 0, 0), at(1, 1, 0), at(0, 1, 0), at(0, 0, 1), at(1, 1, 1), at(0, 1, 1)});
    } else {
      // Around the diagonal, by the order in which the axes are passed (Kuhn, IBM J. Res. Dev. 4 (1960) 518).
      std::array<int, 3> axes{0, 1, 2};
      do {
        std::array<int, 3> first{}, second{};
        first[axes[0]] = second[axes[0]] = second[axes[1]] = 1;
        mesh.cells.push_back({at(0, 0, 0), corner(cell, first), corner(cell, second), at(1, 1, 1)});
      } while (std::next_permutation(axes.begin(), axes.end()));
    }
  }
};

/// A fracture or region that leaves the faces of the grid.
struct Astray {
  std::string what;
  Origin origin;
  Point at;
};

double tolerance_of(const Grid& grid) {
  double shortest = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) shortest = std::min(shortest, grid.box.size()[axis] / grid.cells[axis]);
  return rounding::far_above * shortest;
}

/// The faces of the mesh that together are the polygon, or nothing.
std::optional<std::vector<FaceNodes>> follow(const RawMesh& mesh, const FaceTable& faces, const FlatShape& shape,
                                             double tolerance) {
  const Point low = shape.low().array() - tolerance, high = shape.high().array() + tolerance;
  std::vector<FaceNodes> found;
  double area = 0;
  for (int k = 0; k < faces.size(); ++k) {
    const FaceNodes& face = faces.nodes(k);
    const bool lies_on_it = std::all_of(face.begin(), face.end(), [&](int node) {
      const Point& x = mesh.nodes[node];
      return (x.array() >= low.array()).all() && (x.array() <= high.array()).all() &&
             std::abs(shape.height(x)) < tolerance && shape.contains(shape.in_plane(x), -tolerance);
    });
    if (!lies_on_it) continue;
    const FaceGeometry geometry = face_geometry(mesh.nodes, face);
    if (!shape.contains(shape.in_plane(geometry.center), 0)) continue;
    found.push_back(geometry.normal.dot(shape.normal()) > 0 ? face : reversed(face));
    area += geometry.measure;
  }
  // Faces do not overlap: as large as the polygon, they are all of it.
  if (std::abs(area - shape.area()) > rounding::far_above * shape.area()) return std::nullopt;
  return found;
}

/// A corner that is at no node of the grid, or else the first.
Point stray_corner(const Grid& grid, const std::vector<Point>& corners, double tolerance) {
  for (const Point& corner : corners) {
    std::array<int, 3> at;
    for (int axis = 0; axis < 3; ++axis)
      at[axis] = static_cast<int>(
          std::lround((corner[axis] - grid.box.low[axis]) / (grid.box.size()[axis] / grid.cells[axis])));
    if ((grid.position(at) - corner).norm() > tolerance) return corner;
  }
  return corners.front();
}

/// A place where a plane of a region cuts cells.
std::optional<Point> cut_cell(const RawMesh& mesh, const RegionGeometry& region, double tolerance) {
  for (const CellNodes& cell : mesh.cells) {
    bool is_apart = false, is_cut = false;
    for (const HalfSpace& half : region.half_spaces) {
      int above = 0, below = 0;
      for (const int node : cell) {
        const double depth = (mesh.nodes[node] - half.point).dot(half.normal.normalized());
        above += depth > tolerance, below += depth < -tolerance;
      }
      is_apart = is_apart || above == 0;
      is_cut = is_cut || (above > 0 && below > 0);
    }
    if (is_cut && !is_apart) return cell_geometry(mesh.nodes, cell).center;
  }
  return std::nullopt;
}

RawMesh mesh_of(const Grid& grid) {
  RawMesh mesh;
  for (int k = 0; k <= grid.cells[2]; ++k)
    for (int j = 0; j <= grid.cells[1]; ++j)
      for (int i = 0; i <= grid.cells[0]; ++i) mesh.nodes.push_back(grid.position({i, j, k}));
  for (int k = 0; k < grid.cells[2]; ++k)
    for (int j = 0; j < grid.cells[1]; ++j)
      for (int i = 0; i < grid.cells[0]; ++i) grid.add_cell({i, j, k}, mesh);
  mesh.cells = oriented_cells(mesh);
  return mesh;
}

/// Adds the fractures to a mesh without any, or tells which one, or which region, leaves the faces.
std::optional<Astray> add_fractures(const Grid& grid, const Geometry& geometry, RawMesh& mesh) {
  const double tolerance = tolerance_of(grid);
  if (!geometry.fractures.empty()) {
    const FaceTable faces(mesh.nodes, mesh.cells);
    for (const FractureGeometry& fracture : geometry.fractures) {
      const std::string what = "fracture '" + fracture.name + "'";
      if (fracture.ellipse) return Astray{what, fracture.origin, fracture.ellipse->center};
      auto found = follow(mesh, faces, FlatShape(fracture), tolerance);
      if (!found) return Astray{what, fracture.origin, stray_corner(grid, fracture.points, tolerance)};
      mesh.fractures.push_back({fracture.name, std::move(*found)});
    }
  }
  for (const RegionGeometry& region : geometry.regions)
    if (const auto at = cut_cell(mesh, region, tolerance))
      return Astray{"region '" + region.name + "'", region.origin, *at};
  return std::nullopt;
}

}  // namespace

RawMesh structured_mesh(const Geometry& geometry, const MeshOptions& options) {
  Grid grid{geometry.box, options.cells, options.shape, {0, 0, 0}};
  for (int axis = 0; axis < 3; ++axis) {
    if (grid.cells[axis] > 0) continue;
    grid.cells[axis] = std::max(
        1, static_cast<int>(std::ceil(geometry.box.size()[axis] / far_size(geometry, options) - rounding::same)));
  }
  // Which of its two diagonals each grid plane begins with: of wedges along x and y, of tetrahedra along z as well.
  const int ways = grid.shape == CellShape::hexahedra ? 1 : grid.shape == CellShape::wedges ? 2 : 4;
  std::optional<Astray> astray;
  for (int way = 0; way < ways; ++way) {
    grid.parity = {0, way % 2, way / 2};
    RawMesh mesh = mesh_of(grid);
    const std::optional<Astray> found = add_fractures(grid, geometry, mesh);
    if (!found) {
      take_outer_sides(geometry, mesh);
      assign_regions(geometry, mesh);
      return mesh;
    }
    if (!astray) astray = found;
  }
  throw InputError(astray->origin, astray->what + " does not follow the structured mesh",
                   "with " + std::to_string(grid.cells[0]) + " x " + std::to_string(grid.cells[1]) + " x " +
                       std::to_string(grid.cells[2]) + " cells it leaves the faces of the grid at " +
                       to_text(astray->at),
                   "choose other cells or kind: unstructured");
}

}  // namespace sprekk
