#include "framework/meshing/plane/join_triangles.hpp"

#include <algorithm>
#include <numbers>

#include "framework/mesh/face_table.hpp"
#include "framework/mesh/mesh.hpp"
#include "framework/mesh/plane/cell_shape.hpp"
#include "framework/mesh/quality/cell_angles.hpp"

namespace sprekk {
namespace {

/// Largest deviation of the angles of a quadrilateral from 90 degrees, rad. Two equilateral triangles give 30 degrees.
constexpr double largest_deviation = 50 * std::numbers::pi / 180;

struct Pair {
  double deviation;
  int edge;
  Ring corners;
};

/// The quadrilateral of the two triangles at an edge, counter-clockwise.
Ring around(const RawMesh& mesh, const FaceTable& edges, int edge) {
  const auto [a, c] = edges.nodes(edge);
  const auto opposite = [&](int triangle) {
    const Ring& corners = mesh.cells[triangle];
    return *std::find_if(corners.begin(), corners.end(), [&](int node) { return node != a && node != c; });
  };
  const auto [one, other] = edges.cells(edge);  // the first one has a before c
  return {a, opposite(other), c, opposite(one)};
}

std::vector<Pair> candidates(const RawMesh& mesh, const FaceTable& edges) {
  std::vector<bool> is_fixed(edges.size()), is_end(mesh.nodes.size());
  for (const auto& [name, chain] : mesh.fractures) {
    is_end[chain.front()] = is_end[chain.back()] = true;
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) is_fixed[edges.find({chain[i], chain[i + 1]})] = true;
  }
  std::vector<Pair> pairs;
  for (int edge = 0; edge < edges.size(); ++edge) {
    const auto [one, other] = edges.cells(edge);
    if (is_fixed[edge] || edges.is_outer(edge) || mesh.regions[one] != mesh.regions[other]) continue;
    const Ring corners = around(mesh, edges, edge);
    if (std::any_of(corners.begin(), corners.end(), [&](int node) { return is_end[node]; })) continue;
    if (smallest_corner_area(mesh.nodes, corners) <= 0) continue;
    const auto [smallest, largest] = angles(mesh.nodes, corners);
    const double deviation = std::max(std::numbers::pi / 2 - smallest, largest - std::numbers::pi / 2);
    if (deviation <= largest_deviation) pairs.push_back({deviation, edge, corners});
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return a.deviation != b.deviation ? a.deviation < b.deviation : a.edge < b.edge;
  });
  return pairs;
}

}  // namespace

void join_triangles(RawMesh& mesh) {
  for (Ring& cell : mesh.cells) {
    if (signed_area(mesh.nodes, cell) < 0) cell.turn();
  }
  const FaceTable edges(mesh.nodes, mesh.cells);
  std::vector<bool> is_joined(mesh.cells.size()), is_gone(mesh.cells.size());
  for (const auto& [deviation, edge, corners] : candidates(mesh, edges)) {
    const auto [one, other] = edges.cells(edge);
    if (is_joined[one] || is_joined[other]) continue;
    is_joined[one] = is_joined[other] = true;
    mesh.cells[one] = corners;
    is_gone[other] = true;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < mesh.cells.size(); ++i) {
    if (is_gone[i]) continue;
    mesh.cells[kept] = mesh.cells[i];
    mesh.regions[kept++] = mesh.regions[i];
  }
  mesh.cells.resize(kept);
  mesh.regions.resize(kept);
}

}  // namespace sprekk
