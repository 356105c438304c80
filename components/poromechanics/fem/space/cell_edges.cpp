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

/// The nodes that the walls of a fracture cell share: between them they are parted.
std::vector<char> nodes_at_rims(const Mesh& mesh) {
  std::vector<char> is_at_rim(mesh.node_count(), 0);
  for (const FractureCell& cell : mesh.fracture_cells)
    for (const int node : mesh.face_nodes[cell.faces[0]])
      if (std::ranges::find(mesh.face_nodes[cell.faces[1]], node) != mesh.face_nodes[cell.faces[1]].end())
        is_at_rim[node] = 1;
  return is_at_rim;
}

}  // namespace

std::span<const std::array<int, 2>> edges_of_shape(int corners) {
  SPREKK_EXPECT(shape_with(corners) != nullptr, corners);
  static const std::vector<std::array<int, 2>> tetrahedron = edges_of_faces(4), wedge = edges_of_faces(6),
                                               hexahedron = edges_of_faces(8);
  return corners == 4 ? tetrahedron : corners == 6 ? wedge : hexahedron;
}

CellEdges find_edges(const Mesh& mesh, EdgesWithFunctions which) {
  CellEdges edges;
  edges.is_at_rim = nodes_at_rims(mesh);
  std::map<std::array<int, 2>, int> numbers;
  for (const CellNodes& cell : mesh.cell_nodes) {
    edges.of_cell.emplace_back();
    for (const auto& [one, other] : edges_of_shape(cell.size())) {
      const bool has_function =
          which == EdgesWithFunctions::all || edges.is_at_rim[cell[one]] != edges.is_at_rim[cell[other]];
      if (!has_function) {
        edges.of_cell.back().push_back(none);
        continue;
      }
      const std::array<int, 2> nodes{std::min(cell[one], cell[other]), std::max(cell[one], cell[other])};
      const auto [place, is_new] = numbers.try_emplace(nodes, edges.count());
      if (is_new) edges.nodes.push_back(nodes);
      edges.of_cell.back().push_back(place->second);
    }
  }
  return edges;
}

}  // namespace sprekk::poromechanics
