#include "framework/mesh/face_table.hpp"

#include <algorithm>
#include <string>

#include "framework/config/input_error.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk {
namespace {

int smallest(const FaceNodes& face) { return *std::min_element(face.begin(), face.end()); }

}  // namespace

FaceTable::FaceTable(const std::vector<Point>& nodes, const std::vector<CellNodes>& cells)
    : of_cell_(cells.size()), first_at_node_(nodes.size(), none) {
  const int node_count = static_cast<int>(nodes.size());
  nodes_.reserve(cells.size() * (dimension + 1) / 2 + 16);
  cells_.reserve(nodes_.capacity());
  next_.reserve(nodes_.capacity());
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    for (const int node : cells[cell]) {
      if (node < 0 || node >= node_count) {
        throw InputError("cell " + std::to_string(cell) + " names node " + std::to_string(node) +
                         " (there are nodes 0 to " + std::to_string(node_count - 1) + ")");
      }
    }
    of_cell_[cell] = faces_to_number(cells[cell]);
    for (int k = 0; k < of_cell_[cell].size(); ++k)
      add(nodes, static_cast<int>(cell), k, nodes_of_face(cells[cell], k));
  }
}

void FaceTable::add(const std::vector<Point>& nodes, int cell, int k, const FaceNodes& face) {
  int number = find(face);
  if (number == none) {
    number = size();
    nodes_.push_back(face);
    cells_.push_back({cell, none});
    next_.push_back(first_at_node_[smallest(face)]);
    first_at_node_[smallest(face)] = number;
  } else {
    const auto where = [&] { return to_text(face_geometry(nodes, face).center); };
    if (cells_[number][1] != none) {
      throw InputError("more than two cells meet at the " + std::string(face_name) + " at " + where() +
                       (dimension == 2 ? " (the mesh is not a plane one)" : " (the mesh overlaps itself)"));
    }
    if (turn_alike(nodes_[number], face)) {
      throw InputError("two cells lie on the same side of the " + std::string(face_name) + " at " + where() +
                       " (the mesh overlaps itself)");
    }
    cells_[number][1] = cell;
  }
  of_cell_[cell][k] = number;
}

int FaceTable::find(const FaceNodes& nodes) const {
  const auto [least, largest] = std::minmax_element(nodes.begin(), nodes.end());
  if (*least < 0 || *largest >= static_cast<int>(first_at_node_.size())) return none;
  for (int face = first_at_node_[*least]; face != none; face = next_[face])
    if (have_same_nodes(nodes_[face], nodes)) return face;
  return none;
}

}  // namespace sprekk
