#include "framework/mesh/quality/network_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sprekk {
namespace {

/// The direction from a junction along a cell that ends there.
Point away_from(const FractureCell& cell, const Point& junction) { return (cell.center - junction).normalized(); }

Point place_of(const Mesh& mesh, const Junction& junction) { return mesh.ridges[junction.ridges.front()].center; }

Pocket pocket_from(const Mesh& mesh, int start, std::vector<char>& is_seen, bool& is_open) {
  Pocket pocket{0, 0, Point::Zero(), {}};
  std::vector<int> waiting = {start};
  is_seen[start] = 1;
  is_open = false;
  while (!waiting.empty()) {
    const int cell = waiting.back();
    waiting.pop_back();
    ++pocket.cells;
    pocket.measure += mesh.cell_measure[cell];
    pocket.center += mesh.cell_measure[cell] * mesh.cell_center[cell];
    for (const int face : mesh.cell_faces[cell]) {
      if (mesh.face_side[face] != none) is_open = true;
      if (const int wall = mesh.face_fracture_cell[face]; wall != none)
        pocket.fractures.push_back(mesh.fracture_cells[wall].fracture);
      const auto& [one, other] = mesh.face_cells[face];
      const int next = one == cell ? other : one;
      if (next == none || is_seen[next]) continue;
      is_seen[next] = 1;
      waiting.push_back(next);
    }
  }
  pocket.center /= pocket.measure;
  std::ranges::sort(pocket.fractures);
  const auto repeated = std::ranges::unique(pocket.fractures);
  pocket.fractures.erase(repeated.begin(), repeated.end());
  return pocket;
}

}  // namespace

std::vector<FractureAngle> angles_of_junctions(const Mesh& mesh) {
  std::vector<FractureAngle> angles;
  for (const Junction& junction : mesh.junctions) {
    const Point at = place_of(mesh, junction);
    FractureAngle smallest{none, none, std::numeric_limits<double>::infinity(), at};
    for (std::size_t i = 0; i < junction.cells.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const FractureCell &a = mesh.fracture_cells[junction.cells[i]], &b = mesh.fracture_cells[junction.cells[j]];
        const Point u = away_from(a, at), v = away_from(b, at);
        // Twice the arc tangent of the half angle keeps all digits of small and of straight angles.
        const double angle = 2 * std::atan2((u - v).norm(), (u + v).norm());
        if (angle < smallest.angle) smallest = {b.fracture, a.fracture, angle, at};
      }
    if (smallest.one != none) angles.push_back(smallest);
  }
  return angles;
}

std::vector<Pocket> pockets(const Mesh& mesh) {
  std::vector<char> is_seen(mesh.cell_count(), 0);
  std::vector<Pocket> found;
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    if (is_seen[cell]) continue;
    bool is_open = false;
    Pocket part = pocket_from(mesh, cell, is_seen, is_open);
    if (!is_open) found.push_back(std::move(part));
  }
  std::ranges::stable_sort(found, {}, &Pocket::cells);
  return found;
}

}  // namespace sprekk
