// The numbering of all coefficients of the displacement.
#pragma once

#include "components/poromechanics/fem/cell_edges.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::poromechanics {

/// The coefficients of a displacement, without those of interior functions: its components at every node, then those of
/// every edge, if edges are given, and of every face (see CellPoint), m. Nodes exist once on each side of a fracture,
/// and once in each sector of a junction; at a tip the sides have one node.
struct RawDisplacement {
  const Mesh& mesh;
  const CellEdges* edges = nullptr;  ///< in space
  int edge_count() const { return edges ? edges->count() : 0; }
  int entities() const { return mesh.node_count() + edge_count() + mesh.face_count(); }
  int size() const { return dimension * entities(); }
  int nodes_size() const { return dimension * mesh.node_count(); }
  int of_node(int node) const { return dimension * node; }
  int of_edge(int edge) const { return dimension * (mesh.node_count() + edge); }
  int of_face(int face) const { return dimension * (mesh.node_count() + edge_count() + face); }
  /// The coefficients of the functions of a cell, the first of each.
  std::vector<int> of_cell(int cell) const {
    std::vector<int> first;
    for (const int node : mesh.cell_nodes[cell]) first.push_back(of_node(node));
    if (edge_count() > 0)
      for (const int edge : edges->of_cell[cell])
        if (edge != none) first.push_back(of_edge(edge));
    for (const int face : mesh.cell_faces[cell]) first.push_back(of_face(face));
    return first;
  }
};

}  // namespace sprekk::poromechanics
