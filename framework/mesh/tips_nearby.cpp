#include "framework/mesh/tips_nearby.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace sprekk {
namespace {

/// Edges from the tip to where linear functions do: what they miss falls with the square of the distance.
constexpr int layers = 3;
/// Halfway between two tips both fields count, and a symmetric mesh must have a symmetric answer: neither is taken.
constexpr double clearly = 0.9;
const double straight = std::cos(10 * std::numbers::pi / 180);

/// The fracture cells whose walls are the faces with one cell at a node: {none, none} in the rock.
struct Walls {
  std::array<int, 2> cells{none, none};
  bool are_all = true;  ///< of these faces: not on a side, nor where fractures meet

  Walls(const Mesh& mesh, int node) {
    int count = 0;
    for (const int face : mesh.node_faces[node]) {
      if (mesh.face_cells[face][1] != none) continue;
      are_all = are_all && count < 2 && mesh.face_fracture_cell[face] != none;
      if (are_all) cells[count++] = mesh.face_fracture_cell[face];
    }
  }
};

bool is_tip(const Mesh& mesh, int node) {
  const Walls walls(mesh, node);
  return walls.are_all && walls.cells[0] != none && walls.cells[0] == walls.cells[1];
}

/// Whether the field of a tip, the end of the given fracture cell, goes on at a node.
bool goes_on(const Mesh& mesh, int node, const FractureCell& last) {
  if (mesh.node_cells[node].size() < 2) return false;
  const Walls walls(mesh, node);
  return walls.are_all && std::all_of(walls.cells.begin(), walls.cells.end(), [&](int i) {
           return i == none || (mesh.fracture_cells[i].fracture == last.fracture &&
                                mesh.fracture_cells[i].tangent.dot(last.tangent) > straight);
         });
}

/// The nodes around a tip, with itself.
std::vector<int> surroundings(const Mesh& mesh, int tip) {
  const FractureCell& last = mesh.fracture_cells[Walls(mesh, tip).cells[0]];
  std::vector<int> reached{tip};
  for (int layer = 0, begin = 0; layer < layers; ++layer) {
    const int end = static_cast<int>(reached.size());
    for (; begin < end; ++begin)
      for (const int face : mesh.node_faces[reached[begin]])
        for (const int node : mesh.face_nodes[face])
          if (std::find(reached.begin(), reached.end(), node) == reached.end() && goes_on(mesh, node, last))
            reached.push_back(node);
  }
  return reached;
}

}  // namespace

std::vector<int> tips_nearby(const Mesh& mesh) {
  constexpr double far = std::numeric_limits<double>::infinity();
  struct Nearest {
    int tip = none;
    double distance = far, next = far;  ///< m, to the tip and to the second nearest
  };
  std::vector<Nearest> nearest(mesh.node_count());
  for (int tip = 0; tip < mesh.node_count(); ++tip) {
    if (!is_tip(mesh, tip)) continue;
    for (const int node : surroundings(mesh, tip)) {
      Nearest& at = nearest[node];
      const double distance = (mesh.nodes[node] - mesh.nodes[tip]).norm();
      at.next = std::min(at.next, std::max(at.distance, distance));
      if (distance < at.distance) at = {tip, distance, at.next};
    }
  }
  std::vector<int> nearby;
  for (const Nearest& at : nearest) nearby.push_back(at.distance < clearly * at.next ? at.tip : none);
  return nearby;
}

}  // namespace sprekk
