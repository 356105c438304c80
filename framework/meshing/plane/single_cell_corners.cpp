#include "framework/meshing/single_cell_corners.hpp"

#include <algorithm>
#include <numbers>

#include "framework/mesh/face_table.hpp"
#include "framework/mesh/mesh.hpp"
#include "framework/mesh/plane/cell_shape.hpp"
#include "framework/mesh/plane/planar.hpp"

namespace sprekk {
namespace {

/// A flip is accepted if all angles stay above this, rad.
constexpr double good_angle = 20 * std::numbers::pi / 180;

void turn_counter_clockwise(RawMesh& mesh) {
  for (Ring& cell : mesh.cells) {
    if (signed_area(mesh.nodes, cell) < 0) cell.turn();
  }
}

/// The quadrilateral a, b, c, d, counter-clockwise: triangle `corner` = a b c, whose only inner edge is c a, and its
/// neighbour a c d.
struct Quadrilateral {
  int corner, neighbour;
  int a, b, c, d;
  bool neighbour_is_free;  ///< edges c d and d a are neither outer nor fractures
};

int node_opposite(const RawMesh& mesh, int triangle, int p, int q) {
  for (const int node : mesh.cells[triangle]) {
    if (node != p && node != q) return node;
  }
  return none;
}

/// Removes the single-cell corners that share no triangles with an earlier one of this pass.
class Pass {
 public:
  explicit Pass(RawMesh& mesh)
      : mesh_(mesh), edges_(mesh.nodes, mesh.cells), is_barrier_(edges_.size()), is_stale_(mesh.cells.size()) {
    for (int edge = 0; edge < edges_.size(); ++edge) is_barrier_[edge] = edges_.is_outer(edge);
    for (const auto& [name, chain] : mesh.fractures) {
      for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        const int edge = edges_.find({chain[i], chain[i + 1]});
        if (edge != none) is_barrier_[edge] = true;
      }
    }
  }

  int remove_all() {
    int removed = 0;
    const int count = static_cast<int>(is_stale_.size());
    for (int triangle = 0; triangle < count; ++triangle) {
      if (!is_stale_[triangle] && is_pocket(triangle)) {
        divide(triangle);
        ++removed;
        continue;
      }
      const int k = only_inner_edge(triangle);
      if (k == none || is_stale_[triangle]) continue;
      const auto [one, other] = edges_.cells(edges_.of_cell(triangle)[k]);
      const int neighbour = one == triangle ? other : one;
      if (is_stale_[neighbour]) continue;
      const auto& nodes = mesh_.cells[triangle];
      const int c = nodes[k], a = nodes[(k + 1) % 3], b = nodes[(k + 2) % 3];
      const int barriers = barrier_count(neighbour);
      if (mesh_.cells[neighbour].size() == 4) {
        halve(triangle, neighbour, a, b, c);
      } else {
        remove({triangle, neighbour, a, b, c, node_opposite(mesh_, neighbour, a, c), barriers == 0});
      }
      is_stale_[triangle] = is_stale_[neighbour] = true;
      ++removed;
    }
    return removed;
  }

 private:
  int barrier_count(int triangle) const {
    int count = 0;
    for (const int edge : edges_.of_cell(triangle)) count += is_barrier_[edge] ? 1 : 0;
    return count;
  }

  /// Whether all edges of a cell lie on fractures or sides.
  bool is_pocket(int cell) const {
    const auto& edges = edges_.of_cell(cell);
    return barrier_count(cell) == mesh_.cells[cell].size() &&
           std::any_of(edges.begin(), edges.end(), [&](int edge) { return !edges_.is_outer(edge); });
  }

  int only_inner_edge(int triangle) const {
    if (mesh_.cells[triangle].size() != 3 || barrier_count(triangle) != 2) return none;
    const auto& edges = edges_.of_cell(triangle);
    for (int k = 0; k < 3; ++k) {
      if (!is_barrier_[edges[k]]) return k;
    }
    return none;
  }

  void remove(const Quadrilateral& q) {
    const Point &a = mesh_.nodes[q.a], &b = mesh_.nodes[q.b], &c = mesh_.nodes[q.c], &d = mesh_.nodes[q.d];
    const Point m = 0.5 * (a + c);
    const double flipped = std::min(smallest_angle(a, b, d), smallest_angle(b, c, d));
    const double halved =
        std::min({smallest_angle(a, b, m), smallest_angle(b, c, m), smallest_angle(c, d, m), smallest_angle(d, a, m)});
    const int region = mesh_.regions[q.corner], other_region = mesh_.regions[q.neighbour];
    if (region == other_region && q.neighbour_is_free && flipped > 0 && (flipped >= good_angle || flipped >= halved)) {
      mesh_.cells[q.corner] = {q.a, q.b, q.d};
      mesh_.cells[q.neighbour] = {q.b, q.c, q.d};
      return;
    }
    const int middle = static_cast<int>(mesh_.nodes.size());
    mesh_.nodes.push_back(m);
    mesh_.cells[q.corner] = {q.a, q.b, middle};
    mesh_.cells[q.neighbour] = {q.c, q.d, middle};
    mesh_.cells.push_back({q.b, q.c, middle});
    mesh_.regions.push_back(region);
    mesh_.cells.push_back({q.d, q.a, middle});
    mesh_.regions.push_back(other_region);
  }

  /// Halves the edge c a between the triangle a b c and a quadrilateral.
  void halve(int triangle, int neighbour, int a, int b, int c) {
    const Ring quadrilateral = mesh_.cells[neighbour];
    const int middle = static_cast<int>(mesh_.nodes.size());
    mesh_.nodes.push_back(0.5 * (mesh_.nodes[a] + mesh_.nodes[c]));
    mesh_.cells[triangle] = {a, b, middle};
    add({b, c, middle}, mesh_.regions[triangle]);
    bool is_first = true;
    for (int k = 0; k < quadrilateral.size(); ++k) {
      if (quadrilateral[k] == a) continue;  // this edge leads from a to c and is halved
      const Ring part{quadrilateral[k], quadrilateral.after(k), middle};
      if (is_first) {
        mesh_.cells[neighbour] = part;
      } else {
        add(part, mesh_.regions[neighbour]);
      }
      is_first = false;
    }
  }

  /// Divides a cell into triangles around a new node at its centre.
  void divide(int cell) {
    const Ring nodes = mesh_.cells[cell];
    const int middle = static_cast<int>(mesh_.nodes.size());
    mesh_.nodes.push_back(centroid(mesh_.nodes, nodes));
    mesh_.cells[cell] = {nodes[0], nodes.after(0), middle};
    for (int k = 1; k < nodes.size(); ++k) add({nodes[k], nodes.after(k), middle}, mesh_.regions[cell]);
  }

  void add(const Ring& cell, int region) {
    mesh_.cells.push_back(cell);
    mesh_.regions.push_back(region);
  }

  RawMesh& mesh_;
  const FaceTable edges_;
  std::vector<bool> is_barrier_;  ///< per edge: outer or fracture
  std::vector<bool> is_stale_;    ///< per cell: changed in this pass
};

}  // namespace

int avoid_single_cell_corners(RawMesh& mesh) {
  turn_counter_clockwise(mesh);
  int removed = 0;
  for (;;) {
    const int now = Pass(mesh).remove_all();
    if (now == 0) return removed;
    removed += now;
  }
}

}  // namespace sprekk
