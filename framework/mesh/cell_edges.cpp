#include "framework/mesh/cell_edges.hpp"

#include <algorithm>
#include <string>

#include "framework/config/input_error.hpp"
#include "framework/mesh/mesh.hpp"
#include "framework/mesh/planar.hpp"

namespace sprekk {

CellEdges::CellEdges(const std::vector<Point>& nodes, const std::vector<Ring>& cells)
    : of_cell_(cells), first_at_node_(nodes.size(), none) {
  const int node_count = static_cast<int>(nodes.size());
  nodes_.reserve(cells.size() * 3 / 2 + 16);
  cells_.reserve(nodes_.capacity());
  next_.reserve(nodes_.capacity());
  for (std::size_t t = 0; t < cells.size(); ++t) {
    const Ring& cell = cells[t];
    for (const int node : cell) {
      if (node < 0 || node >= node_count) {
        throw InputError("cell " + std::to_string(t) + " names node " + std::to_string(node) +
                         " (there are nodes 0 to " + std::to_string(node_count - 1) + ")");
      }
    }
    for (int k = 0; k < cell.size(); ++k) {
      const int a = cell[k], b = cell.after(k);
      int edge = find(a, b);
      if (edge == none) {
        edge = size();
        nodes_.push_back({a, b});
        cells_.push_back({static_cast<int>(t), none});
        next_.push_back(first_at_node_[std::min(a, b)]);
        first_at_node_[std::min(a, b)] = edge;
      } else {
        const auto where = [&] { return to_text(0.5 * (nodes[a] + nodes[b])); };
        if (cells_[edge][1] != none) {
          throw InputError("more than two cells meet at the edge at " + where() + " (the mesh is not a plane one)");
        }
        if (nodes_[edge][0] == a) {
          throw InputError("two cells lie on the same side of the edge at " + where() + " (the mesh overlaps itself)");
        }
        cells_[edge][1] = static_cast<int>(t);
      }
      of_cell_[t][k] = edge;
    }
  }
}

int CellEdges::find(int a, int b) const {
  if (std::min(a, b) < 0 || std::max(a, b) >= static_cast<int>(first_at_node_.size())) return none;
  for (int edge = first_at_node_[std::min(a, b)]; edge != none; edge = next_[edge]) {
    if (std::max(nodes_[edge][0], nodes_[edge][1]) == std::max(a, b)) return edge;
  }
  return none;
}

}  // namespace sprekk
