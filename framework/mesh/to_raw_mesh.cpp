// From a mesh back to the one that it was built from.
#include <algorithm>

#include "framework/joined_sets.hpp"
#include "framework/mesh/build_mesh.hpp"

namespace sprekk {

RawMesh to_raw_mesh(const Mesh& mesh, std::vector<int>* merged) {
  // The copies of a node are tied to each other across the fracture cells that end there.
  JoinedSets copies(mesh.node_count());
  for (const FractureCell& cell : mesh.fracture_cells) {
    const FaceNodes &plus = mesh.face_nodes[cell.faces[0]], &minus = mesh.face_nodes[cell.faces[1]];
    for (const int node : plus)
      copies.join(node, *std::ranges::find_if(minus, [&](int other) { return mesh.nodes[other] == mesh.nodes[node]; }));
  }

  RawMesh raw;
  std::vector<int> number(mesh.nodes.size());
  for (int node = 0; node < mesh.node_count(); ++node) {
    if (copies.root(node) == node) {
      number[node] = static_cast<int>(raw.nodes.size());
      raw.nodes.push_back(mesh.nodes[node]);
    } else {
      number[node] = number[copies.root(node)];  // the root has the smaller index
    }
  }
  const auto renumbered = [&](FaceNodes nodes) {
    for (int& node : nodes) node = number[node];
    return nodes;
  };
  raw.cells = mesh.cell_nodes;
  for (CellNodes& cell : raw.cells) {
    for (int& node : cell) node = number[node];
  }
  raw.regions = mesh.cell_region;
  raw.region_names = mesh.region_names;
  raw.side_names = mesh.side_names;
  for (int face = 0; face < mesh.face_count(); ++face) {
    if (mesh.face_side[face] == none) continue;
    raw.boundary_faces.push_back({renumbered(mesh.face_nodes[face]), mesh.face_side[face]});
  }
  for (const Fracture& fracture : mesh.fractures) {
    std::vector<FaceNodes> faces;
    for (int i = fracture.first_cell; i < fracture.first_cell + fracture.cell_count; ++i)
      faces.push_back(renumbered(mesh.face_nodes[mesh.fracture_cells[i].faces[0]]));
    raw.fractures.push_back(fracture_with(fracture.name, faces));
  }
  if (merged) *merged = std::move(number);
  return raw;
}

}  // namespace sprekk
