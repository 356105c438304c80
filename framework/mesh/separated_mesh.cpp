#include "framework/mesh/separated_mesh.hpp"

#include <utility>

#include "framework/invariants.hpp"
#include "framework/mesh/build_mesh.hpp"

namespace sprekk {

Mesh separated_mesh(const Mesh& mesh, const std::vector<char>& inside) {
  SPREKK_EXPECT(static_cast<int>(inside.size()) == mesh.cell_count(), inside.size(), mesh.cell_count());
  Mesh cut = mesh;
  cut.version = next_mesh_version();

  std::vector<int> copy(mesh.node_count());  // of a node, for the cells that are not inside
  for (int node = 0; node < mesh.node_count(); ++node) {
    copy[node] = node;
    bool some = false, all = true;
    for (const int cell : mesh.node_cells[node]) {
      some = some || inside[cell];
      all = all && inside[cell];
    }
    if (!some || all) continue;
    copy[node] = cut.node_count();
    cut.nodes.push_back(mesh.nodes[node]);
  }
  for (int cell = 0; cell < mesh.cell_count(); ++cell)
    if (!inside[cell])
      for (int& node : cut.cell_nodes[cell]) node = copy[node];

  for (int face = 0; face < mesh.face_count(); ++face) {
    const auto [cell, other] = mesh.face_cells[face];
    const bool first = inside[cell], second = other == none ? first : static_cast<bool>(inside[other]);
    if (!first && !second)
      for (int& node : cut.face_nodes[face]) node = copy[node];
    if (first == second) continue;
    const int outside = first ? other : cell;
    // As either cell has it: for the one that is not inside in the reverse order.
    const FaceNodes nodes = first ? mesh.face_nodes[face] : reversed(mesh.face_nodes[face]);
    const Point normal = first ? mesh.face_normal[face] : Point(-mesh.face_normal[face]);
    FaceNodes copies = reversed(nodes);
    for (int& node : copies) node = copy[node];
    cut.face_nodes[face] = nodes;
    cut.face_normal[face] = normal;
    cut.face_cells[face] = {first ? cell : other, none};
    for (int& of_cell : cut.cell_faces[outside])
      if (of_cell == face) of_cell = cut.face_count();
    cut.face_nodes.push_back(copies);
    cut.face_normal.push_back(-normal);
    cut.face_cells.push_back({outside, none});
    cut.face_center.push_back(mesh.face_center[face]);
    cut.face_measure.push_back(mesh.face_measure[face]);
    cut.face_side.push_back(none);
    cut.face_fracture_cell.push_back(none);
  }

  std::vector<std::vector<int>> cells(cut.node_count()), faces(cut.node_count());
  for (int cell = 0; cell < cut.cell_count(); ++cell)
    for (const int node : cut.cell_nodes[cell]) cells[node].push_back(cell);
  for (int face = 0; face < cut.face_count(); ++face)
    for (const int node : cut.face_nodes[face]) faces[node].push_back(face);
  cut.node_cells = {};
  cut.node_faces = {};
  for (int node = 0; node < cut.node_count(); ++node) {
    cut.node_cells.append_set(cells[node]);
    cut.node_faces.append_set(faces[node]);
  }
  return cut;
}

}  // namespace sprekk
