// The numbering of all coefficients of the displacement.
#pragma once

#include "framework/mesh/mesh.hpp"

namespace sprekk::poromechanics {

/// The coefficients of a displacement, without those of interior functions: its components at every node, and then
/// those of every face (see CellPoint), m. Nodes exist once on each side of a fracture, and once in each sector of a
/// junction; at a tip the sides have one node.
struct RawDisplacement {
  const Mesh& mesh;
  int entities() const { return mesh.node_count() + mesh.face_count(); }
  int size() const { return dimension * entities(); }
  int nodes_size() const { return dimension * mesh.node_count(); }
  int of_node(int node) const { return dimension * node; }
  int of_face(int face) const { return dimension * (mesh.node_count() + face); }
  /// The coefficients of the functions of corners and faces of a cell, the first of each.
  std::vector<int> of_cell(int cell) const {
    std::vector<int> first;
    for (const int node : mesh.cell_nodes[cell]) first.push_back(of_node(node));
    for (const int face : mesh.cell_faces[cell]) first.push_back(of_face(face));
    return first;
  }
};

}  // namespace sprekk::poromechanics
