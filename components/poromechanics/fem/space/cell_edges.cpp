#include "components/poromechanics/fem/cell_edges.hpp"

#include <algorithm>
#include <map>

#include "framework/invariants.hpp"

namespace sprekk::poromechanics {

namespace {

/// In the order in which the faces of the shape have them.
std::vector<std::array<int, 2>> edges_of_faces(int corners) {
  std::vector<std::array<int, 2>> edges;
  for (const FaceNodes& face : shape_with(corners)->faces)
    for (int k = 0; k < face.size(); ++k) {
      const std::array<int, 2> edge{std::min(face[k], face.after(k)), std::max(face[k], face.after(k))};
      if (std::ranges::find(edges, edge) == edges.end()) edges.push_back(edge);
    }
  return edges;
}

}  // namespace

std::span<const std::array<int, 2>> edges_of_shape(int corners) {
  SPREKK_EXPECT(shape_with(corners) != nullptr, corners);
  static const std::vector<std::array<int, 2>> tetrahedron = edges_of_faces(4), wedge = edges_of_faces(6),
                                               hexahedron = edges_of_faces(8);
  return corners == 4 ? tetrahedron : corners == 6 ? wedge : hexahedron;
}

CellEdges find_edges(const Mesh& mesh) {
  CellEdges edges;
  std::map<std::array<int, 2>, int> numbers;
  for (const CellNodes& cell : mesh.cell_nodes) {
    edges.of_cell.emplace_back();
    for (const auto& [one, other] : edges_of_shape(cell.size())) {
      const std::array<int, 2> nodes{std::min(cell[one], cell[other]), std::max(cell[one], cell[other])};
      const auto [place, is_new] = numbers.try_emplace(nodes, edges.count());
      if (is_new) edges.nodes.push_back(nodes);
      edges.of_cell.back().push_back(place->second);
    }
  }
  return edges;
}

}  // namespace sprekk::poromechanics
