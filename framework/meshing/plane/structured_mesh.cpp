#include "framework/meshing/structured_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "framework/mesh/mesh.hpp"
#include "framework/mesh/plane/planar.hpp"
#include "framework/meshing/regions.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

/// The grid's nodes, and which diagonal each of its rectangles has.
struct Grid {
  Box box;
  std::array<int, 2> cells;
  bool has_diagonals;
  int parity;  ///< rectangle (i, j) is cut from its lower left to its upper right corner when i + j + parity is even

  bool rises(int i, int j) const { return (i + j + parity) % 2 == 0; }
  int node(int i, int j) const { return j * (cells[0] + 1) + i; }
  Point position(int i, int j) const {
    const auto at = [&](int axis, int index) {
      return index == cells[axis] ? box.high[axis] : box.low[axis] + index * (box.size()[axis] / cells[axis]);
    };
    return {at(0, i), at(1, j)};
  }
  bool joined(int i, int j, int di, int dj) const {
    if (i + di < 0 || i + di > cells[0] || j + dj < 0 || j + dj > cells[1]) return false;
    if (di == 0 || dj == 0) return true;
    return has_diagonals && rises(std::min(i, i + di), std::min(j, j + dj)) == (di == dj);
  }
};

/// The nodes along a segment, or nothing when it leaves the edges of the grid.
std::optional<std::vector<int>> follow(const Grid& grid, const Segment& segment) {
  const Point width = grid.box.size().cwiseQuotient(Point(grid.cells[0], grid.cells[1]));
  const double tolerance = rounding::far_above * width.minCoeff();
  const auto is_at = [&](int i, int j, const Point& x) { return (grid.position(i, j) - x).norm() < tolerance; };

  const Point start = (segment.from - grid.box.low).cwiseQuotient(width);
  int i = static_cast<int>(std::lround(start.x())), j = static_cast<int>(std::lround(start.y()));
  if (!is_at(i, j, segment.from)) return std::nullopt;
  std::vector<int> nodes{grid.node(i, j)};
  while (!is_at(i, j, segment.to)) {
    const Point ahead = segment.to - grid.position(i, j);
    bool moved = false;
    for (int dj = -1; dj <= 1 && !moved; ++dj) {
      for (int di = -1; di <= 1 && !moved; ++di) {
        if ((di == 0 && dj == 0) || !grid.joined(i, j, di, dj)) continue;
        const Point next = grid.position(i + di, j + dj);
        if ((next - grid.position(i, j)).dot(ahead) <= 0 || distance(next, segment) > tolerance) continue;
        i += di, j += dj;
        moved = true;
      }
    }
    if (!moved) return std::nullopt;
    nodes.push_back(grid.node(i, j));
  }
  return nodes;
}

std::optional<RawMesh::Chain> follow(const Grid& grid, const FractureGeometry& fracture) {
  RawMesh::Chain chain{fracture.name, {}};
  for (std::size_t i = 0; i + 1 < fracture.points.size(); ++i) {
    const auto nodes = follow(grid, Segment{fracture.points[i], fracture.points[i + 1]});
    if (!nodes) return std::nullopt;
    chain.nodes.insert(chain.nodes.end(), nodes->begin() + (i == 0 ? 0 : 1), nodes->end());
  }
  return chain;
}

/// Whether the outline of a region lies on edges of the grid.
bool follows(const Grid& grid, const RegionGeometry& region) {
  const std::vector<Point>& corners = region.polygon;
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (!follow(grid, Segment{corners[i], corners[(i + 1) % corners.size()]})) return false;
  return true;
}

/// The first fracture or region that leaves the edges of the grid.
struct Astray {
  std::string what;
  Origin origin;
};

std::optional<Astray> first_off_grid(const Grid& grid, const Geometry& geometry) {
  for (const FractureGeometry& fracture : geometry.fractures)
    if (!follow(grid, fracture)) return Astray{"fracture '" + fracture.name + "'", fracture.origin};
  for (const RegionGeometry& region : geometry.regions)
    if (!follows(grid, region)) return Astray{"region '" + region.name + "'", region.origin};
  return std::nullopt;
}

Grid choose_grid(const Geometry& geometry, const MeshOptions& options) {
  Grid grid{geometry.box, options.cells, options.shape == MeshOptions::Shape::triangles, 0};
  for (int axis = 0; axis < 2; ++axis) {
    if (grid.cells[axis] > 0) continue;
    grid.cells[axis] = std::max(
        1, static_cast<int>(std::ceil(geometry.box.size()[axis] / far_size(geometry, options) - rounding::same)));
  }
  const std::optional<Astray> astray = first_off_grid(grid, geometry);
  if (!astray) return grid;
  grid.parity = 1;
  if (!first_off_grid(grid, geometry)) return grid;
  throw InputError(astray->origin, astray->what + " does not follow the structured mesh",
                   "with " + std::to_string(grid.cells[0]) + " x " + std::to_string(grid.cells[1]) +
                       " cells it leaves the grid lines" + (grid.has_diagonals ? " and diagonals" : ""),
                   "choose other cells or kind: unstructured");
}

}  // namespace

RawMesh structured_mesh(const Geometry& geometry, const MeshOptions& options) {
  const Grid grid = choose_grid(geometry, options);
  const auto [nx, ny] = grid.cells;
  RawMesh mesh;
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) mesh.nodes.push_back(grid.position(i, j));
  }
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const int a = grid.node(i, j), b = grid.node(i + 1, j), c = grid.node(i + 1, j + 1), d = grid.node(i, j + 1);
      if (!grid.has_diagonals) {
        mesh.cells.push_back({a, b, c, d});
      } else if (grid.rises(i, j)) {
        mesh.cells.push_back({a, b, c});
        mesh.cells.push_back({a, c, d});
      } else {
        mesh.cells.push_back({a, b, d});
        mesh.cells.push_back({b, c, d});
      }
    }
  }
  mesh.side_names.assign(box_sides.begin(), box_sides.end());
  for (int j = 0; j < ny; ++j) {
    mesh.boundary_faces.push_back({{grid.node(0, j + 1), grid.node(0, j)}, 0});
    mesh.boundary_faces.push_back({{grid.node(nx, j), grid.node(nx, j + 1)}, 1});
  }
  for (int i = 0; i < nx; ++i) {
    mesh.boundary_faces.push_back({{grid.node(i, 0), grid.node(i + 1, 0)}, 2});
    mesh.boundary_faces.push_back({{grid.node(i + 1, ny), grid.node(i, ny)}, 3});
  }
  for (const FractureGeometry& fracture : geometry.fractures) mesh.fractures.push_back(*follow(grid, fracture));
  assign_regions(geometry, mesh);
  return mesh;
}

}  // namespace sprekk
