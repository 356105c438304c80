#include "framework/meshing/distort_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "framework/mesh/face_table.hpp"
#include "framework/mesh/plane/cell_shape.hpp"

namespace sprekk {
namespace {

constexpr double smallest_area_kept = 0.2;  // of a cell: no cell may turn over
constexpr int most_halvings = 6;            // of a move that would

double area(const RawMesh& mesh, int cell) { return smallest_corner_area(mesh.nodes, mesh.cells[cell]); }

std::vector<bool> fixed_nodes(const RawMesh& mesh, const FaceTable& edges) {
  std::vector<bool> is_fixed(mesh.nodes.size(), false);
  for (int edge = 0; edge < edges.size(); ++edge) {
    const auto [one, other] = edges.cells(edge);
    if (!edges.is_outer(edge) && mesh.regions[one] == mesh.regions[other]) continue;
    for (const int node : edges.nodes(edge)) is_fixed[node] = true;
  }
  for (const auto& [name, chain] : mesh.fractures) {
    for (const int node : chain) is_fixed[node] = true;
  }
  return is_fixed;
}

}  // namespace

void distort_mesh(RawMesh& mesh, double amount, int seed) {
  if (amount == 0) return;
  for (Ring& cell : mesh.cells) {
    if (signed_area(mesh.nodes, cell) < 0) cell.turn();
  }
  const FaceTable edges(mesh.nodes, mesh.cells);
  const auto is_fixed = fixed_nodes(mesh, edges);
  std::vector<double> shortest(mesh.nodes.size(), std::numeric_limits<double>::infinity());
  for (int edge = 0; edge < edges.size(); ++edge) {
    const auto [a, b] = edges.nodes(edge);
    const double length = (mesh.nodes[a] - mesh.nodes[b]).norm();
    for (const int node : {a, b}) shortest[node] = std::min(shortest[node], length);
  }
  std::vector<std::vector<int>> cells_at(mesh.nodes.size());
  std::vector<double> area_before(mesh.cells.size());
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell) {
    area_before[cell] = area(mesh, cell);
    for (const int node : mesh.cells[cell]) cells_at[node].push_back(cell);
  }

  std::mt19937 random(static_cast<unsigned>(seed));
  // The distributions of the standard library differ between implementations; these numbers are the same everywhere.
  const auto from_0_to_1 = [&] { return random() / 4294967296.0; };
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    if (is_fixed[node] || cells_at[node].empty()) continue;
    const double angle = 2 * std::numbers::pi * from_0_to_1();
    Point move = amount * shortest[node] * std::sqrt(from_0_to_1()) * Point(std::cos(angle), std::sin(angle));
    const Point before = mesh.nodes[node];
    const auto keeps_areas = [&] {
      return std::all_of(cells_at[node].begin(), cells_at[node].end(),
                         [&](int cell) { return area(mesh, cell) >= smallest_area_kept * area_before[cell]; });
    };
    mesh.nodes[node] = before + move;
    for (int i = 0; i < most_halvings && !keeps_areas(); ++i) mesh.nodes[node] = before + (move *= 0.5);
    if (!keeps_areas()) mesh.nodes[node] = before;
  }
}

}  // namespace sprekk
